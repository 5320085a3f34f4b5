"""What run_tests.py counts and names: of a program that passes, fails, skips, crashes, hangs or leaks as told."""

import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "../../src/scripts/run_tests.py")

# Its tests are named after what they do.
PROGRAM = """#!{python}
import os, sys, time
names = [a for a in sys.argv if a.startswith("--gtest_filter=")][0].split("=", 1)[1].split(":")
open("{folder}/runs", "a").write(" ".join(names) + "\\n")
for name in names:
    print("[ RUN      ]", name, flush=True)
    if "Crash" in name:
        os.abort()
    if "Hang" in name:
        time.sleep(60)
    if "Skip" in name:
        print("a.cpp:1: Skipped\\nneeds a file")
    verdict = "  FAILED  " if "Fail" in name else "  SKIPPED " if "Skip" in name else "       OK "
    print("no end of line", end="")
    print("[" + verdict + "]", name, "(0 ms)", flush=True)
if "A.Leak" in names:
    print("ERROR: LeakSanitizer: detected memory leaks\\n    #0 in f\\nSUMMARY: AddressSanitizer: 24 bytes leaked.\\n")
    sys.exit(23)
"""


class RunTests(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.folder = self.place.name
        self.write("CMakeCache.txt", "")
        self.write("data", "1")
        self.write("program", PROGRAM.format(python=sys.executable, folder=self.folder))
        self.write("program.reads", self.path("data"))
        os.chmod(self.path("program"), 0o755)

    def tearDown(self):
        self.place.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def run_tests(self, *names, arguments=()):
        """The lines of the report, and how often the program was started."""
        tests = [f'add_test({name} "{self.path("program")}" "--gtest_filter={name}")\n' for name in names]
        tests += [f"set_tests_properties({name} PROPERTIES TIMEOUT {1 if 'Hang' in name else 50})\n" for name in names]
        self.write("CTestTestfile.cmake", "".join(tests))
        self.write("runs", "")
        command = [sys.executable, SCRIPT, self.folder, self.path("report"), *arguments]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return self.read("report").splitlines(), len(self.read("runs").splitlines())

    def test_many_tests_share_a_process(self):
        self.assertEqual(self.run_tests(*[f"A.B{i}" for i in range(130)]), (["130 0 0"], 2))

    def test_failed_and_skipped_tests_are_named(self):
        lines, starts = self.run_tests("A.Fail", "A.Skip", "A.B")
        self.assertEqual(lines, ["1 1 1", "FAILED  A.Fail", "SKIPPED A.Skip: needs a file"])
        self.assertEqual(starts, 1)

    def test_what_follows_a_crash_is_run(self):
        self.assertEqual(self.run_tests("A.B", "A.Crash", "A.C", "A.D"), (["3 1 0", "FAILED  A.Crash"], 2))

    def test_a_test_that_hangs_has_failed(self):
        self.assertEqual(self.run_tests("A.B", "A.Hang", "A.C"), (["2 1 0", "FAILED  A.Hang"], 2))

    def test_a_leak_at_the_end_is_a_failure(self):
        failure = "FAILED  program at its end: exit status 23, SUMMARY: AddressSanitizer: 24 bytes leaked."
        self.assertEqual(self.run_tests("A.B", "A.Leak")[0], ["2 1 0", failure])

    def test_what_passed_is_not_run_again_until_something_changes(self):
        note = f"UNCHANGED in {self.folder}, passed before, not run again: program (2)"
        unchanged = (["2 0 0", note], 0)
        again = (["2 0 0"], 1)
        self.assertEqual(self.run_tests("A.B", "A.C"), again)
        self.assertEqual(self.run_tests("A.B", "A.C"), unchanged)
        self.assertEqual(self.run_tests("A.B", "A.C", arguments=["--all"]), again)
        self.write("data", "2")
        self.assertEqual(self.run_tests("A.B", "A.C"), again)
        self.write("program", self.read("program") + "# changed\n")
        self.assertEqual(self.run_tests("A.B", "A.C"), again)
        self.assertEqual(self.run_tests("A.B", "A.D"), again)
        self.assertEqual(self.run_tests("A.B", "A.D"), unchanged)

    def test_what_failed_is_run_again(self):
        for name in ("A.Fail", "A.Leak"):
            self.run_tests("A.B", name)
            self.assertEqual(self.run_tests("A.B", name)[1], 1)

    def test_of_a_program_with_skipped_tests_only_these_are_run_again(self):
        note = f"UNCHANGED in {self.folder}, passed before, not run again: program (1)"
        skipped = "SKIPPED A.Skip: needs a file"
        self.assertEqual(self.run_tests("A.B", "A.Skip"), (["1 0 1", skipped], 1))
        for _ in range(2):
            self.assertEqual(self.run_tests("A.B", "A.Skip"), (["1 0 1", skipped, note], 1))

    def test_what_is_no_google_test_is_left_to_ctest(self):
        self.write("CTestTestfile.cmake", 'add_test(A "true")\nadd_test(B "false")\n')
        command = [sys.executable, SCRIPT, self.folder, self.path("report")]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(self.read("report").splitlines(), ["1 1 0", "FAILED  B"])

    def test_a_program_that_is_no_google_test_is_not_run_again_until_it_changes(self):
        self.write("lone", f"#!/bin/sh\necho >> {self.path('runs')}\n")
        os.chmod(self.path("lone"), 0o755)
        self.write("CTestTestfile.cmake", f'add_test(A "{self.path("lone")}")\n')
        self.assertEqual(self.run_ctest(), (["1 0 0"], 1))
        note = f"UNCHANGED in {self.folder}, passed before, not run again: A (1)"
        self.assertEqual(self.run_ctest(), (["1 0 0", note], 0))
        self.assertEqual(self.run_ctest("--all"), (["1 0 0"], 1))
        self.write("lone", self.read("lone") + "exit 1\n")
        self.assertEqual(self.run_ctest(), (["0 1 0", "FAILED  A"], 1))
        self.assertEqual(self.run_ctest(), (["0 1 0", "FAILED  A"], 1))

    def test_what_says_on_what_it_hangs_is_not_run_again_with_what_is_run_for_it(self):
        reads = f'REQUIRED_FILES "{self.path("data")}"'
        tests = [f'add_test({name} sh -c "echo >> {self.path("runs")}")\n' for name in "ABC"]
        tests.append(f"set_tests_properties(A PROPERTIES FIXTURES_SETUP f {reads})\n")
        tests.append(f"set_tests_properties(B PROPERTIES FIXTURES_REQUIRED f {reads})\n")
        self.write("CTestTestfile.cmake", "".join(tests))
        self.assertEqual(self.run_ctest(), (["3 0 0"], 3))
        note = f"UNCHANGED in {self.folder}, passed before, not run again: A (2)"
        self.assertEqual(self.run_ctest(), (["3 0 0", note], 1))
        self.write("data", "2")
        self.assertEqual(self.run_ctest(), (["3 0 0"], 3))
        tests[4] = "set_tests_properties(B PROPERTIES FIXTURES_REQUIRED f)\n"
        self.write("CTestTestfile.cmake", "".join(tests))
        self.assertEqual([self.run_ctest(), self.run_ctest()], 2 * [(["3 0 0"], 3)])

    def run_ctest(self, *arguments):
        self.write("runs", "")
        command = [sys.executable, SCRIPT, self.folder, self.path("report"), *arguments]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return self.read("report").splitlines(), len(self.read("runs").splitlines())

    def test_what_costs_most_comes_first(self):
        for name in ("cheap", "costly"):
            self.write(name, PROGRAM.format(python=sys.executable, folder=self.folder))
            os.chmod(self.path(name), 0o755)
        tests = [f'add_test(A.{name} "{self.path(name)}" "--gtest_filter=A.{name}")\n' for name in ("cheap", "costly")]
        tests.append("set_tests_properties(A.costly PROPERTIES COST 9)\n")
        self.write("CTestTestfile.cmake", "".join(tests))
        self.run_ctest("--jobs", "1")
        self.assertEqual(self.read("runs").split(), ["A.costly", "A.cheap"])


if __name__ == "__main__":
    unittest.main()
