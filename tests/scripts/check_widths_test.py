"""Which lines check_widths.py names."""

import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "../../src/scripts/check_widths.py")


def named_lines(*lines):
    with tempfile.NamedTemporaryFile("w", suffix=".md", encoding="utf-8") as file:
        file.write("".join(line + "\n" for line in lines))
        file.flush()
        ran = subprocess.run([sys.executable, SCRIPT, file.name], stdout=subprocess.PIPE, text=True, check=False)
        named = [line.replace(file.name, "FILE") for line in ran.stdout.splitlines()]
        assert ran.returncode == (1 if named else 0)
        return named


class CheckWidths(unittest.TestCase):
    def test_a_wide_line_is_named(self):
        self.assertEqual(named_lines("a", "a " + "b" * 119), ["FILE:2: 121 columns, more than 120"])

    def test_120_columns_are_not_too_many(self):
        self.assertEqual(named_lines("a " + "ü" * 118), [])

    def test_tables_may_be_wide(self):
        self.assertEqual(named_lines("| a " + "b " * 80 + "|"), [])

    def test_what_cannot_be_broken_may_be_wide(self):
        self.assertEqual(named_lines("- https://" + "a" * 120, "# " + "b" * 130), [])


if __name__ == "__main__":
    unittest.main()
