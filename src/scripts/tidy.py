#!/usr/bin/env python3
"""tidy.py FOLDER PLACE ...: clang-tidy over the sources under each place; FOLDER was configured for Clang.

A source is not looked at again until it changes, or a header that it includes, how it is compiled, .clang-tidy, or
clang-tidy itself. The headers are those that ninja knows: a source that was not compiled yet is always looked at.
"""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

from stamps import Stamps, files_in, key_of


def known_headers(folder):
    """The files that each object was made from."""
    listing = subprocess.check_output(["ninja", "-C", folder, "-t", "deps"], text=True)
    headers = {}
    for block in listing.split("\n\n"):
        lines = block.strip().splitlines()
        if match := lines and re.match(r"(.+): #deps \d+, .*\(VALID\)$", lines[0]):
            headers[match[1]] = [os.path.normpath(os.path.join(folder, line.strip())) for line in lines[1:]]
    return headers


def object_of(entry):
    words = shlex.split(entry["command"])
    return words[words.index("-o") + 1]


def main():
    folder, places = sys.argv[1], sys.argv[2:]
    sources = [path for place in places for path in files_in(os.path.abspath(place)) if path.endswith(".cpp")]
    with open(os.path.join(folder, "compile_commands.json"), encoding="utf-8") as file:
        entries = {entry["file"]: entry for entry in json.load(file)}
    version = subprocess.check_output(["clang-tidy", "--version"], text=True)
    headers = known_headers(folder)
    stamps = Stamps(os.path.join(folder, "tidy.json"))

    def look_at(source):
        entry = entries.get(source)
        made_from = entry and headers.get(object_of(entry))
        key = key_of([version, entry["command"]], [".clang-tidy", source] + made_from) if made_from else None
        if key and stamps.is_good(source, key):
            return "unchanged"
        command = ["clang-tidy", "--quiet", "-p", folder, source]
        ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if ran.returncode:
            print(ran.stdout, end="", flush=True)
        stamps.set(source, None if ran.returncode else key)
        return "wrong" if ran.returncode else "clean"

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        verdicts = list(pool.map(look_at, sources))
    counts = ", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in ("clean", "wrong", "unchanged"))
    print(f"clang-tidy: {len(sources)} sources: {counts}")
    sys.exit("wrong" in verdicts)


if __name__ == "__main__":
    main()
