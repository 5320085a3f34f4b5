#!/usr/bin/env python3
"""Names each line of the files given that is wider than 120 columns: what clang-format does not look at, such as prose
and shaders. Lines of tables may be, and lines that cannot be broken, such as a link.
"""

import sys

WIDTH = 120


def may_be_wide(line):
    text = line.strip()
    # A list's mark, a comment's mark: no places to break a line at.
    words = [word for word in text.split() if word not in ("-", "*", "#", "//", ">")]
    return text.startswith("|") or len(words) == 1


def main():
    wide = 0
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                columns = len(line.rstrip("\n"))
                if columns > WIDTH and not may_be_wide(line):
                    print(f"{path}:{number}: {columns} columns, more than {WIDTH}")
                    wide += 1
    sys.exit(wide > 0)


if __name__ == "__main__":
    main()
