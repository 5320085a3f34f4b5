#!/usr/bin/env python3
"""tidy.py [--steps N] FOLDER PLACE ...: clang-tidy over the sources under each place; FOLDER was configured for Clang.

The static analyzer follows the paths through a function for 225,000 steps, or for as many as --steps says. 20,000 take
a third of the time, and the one fault it has found here is among what it finds so.

Sources that the build compiles as one (LKAO_UNITY_BUILD) are looked at as one, since most of the time goes into what
they include. Their texts are put into one file: the analyzer passes by what a file includes.

A source is not looked at again until it changes, or a header that it includes, how it is compiled, .clang-tidy, or
clang-tidy itself. The headers are those that ninja knows: a source that was not compiled yet is always looked at.
"""

import argparse
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


def sources_of(entry):
    """What an entry of compile_commands.json compiles: one source, or those that a file of CMake's includes."""
    path = entry["file"]
    if "/Unity/" not in path:
        return [path]
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#include "(.+)"$', file.read(), re.MULTILINE)


class Together:
    """Some sources as one file, and whence its lines come."""

    def __init__(self, folder, sources):
        self.path = os.path.join(os.path.abspath(folder), "tidy", key_of(sources, []) + ".cpp")
        self.starts = []  # first line, source
        lines = []
        for source in sources:
            self.starts.append((len(lines), source))
            with open(source, encoding="utf-8") as file:
                lines += file.read().splitlines()
        os.makedirs(os.path.dirname(self.path), exist_ok=True)
        with open(self.path, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")

    def name_sources(self, text):
        def place(match):
            line = int(match[1])
            start, source = [pair for pair in self.starts if pair[0] < line][-1]
            return f"{source}:{line - start}:"

        return re.sub(re.escape(self.path) + r":(\d+):", place, text)


def flags_of(entry):
    words = shlex.split(entry["command"])
    words = words[1 + ("ccache" in words[0]) :]
    for option, count in (("-o", 2), ("-c", 2)):
        if option in words:
            del words[words.index(option) : words.index(option) + count]
    return [word for word in words if word != entry["file"]]


def main():
    parser = argparse.ArgumentParser(description="clang-tidy over the sources under each place.")
    parser.add_argument("--steps", type=int, default=225000, help="of the analyzer, in each function")
    parser.add_argument("folder", help="a build folder, configured for Clang")
    parser.add_argument("places", nargs="+")
    options = parser.parse_args()
    folder, places = options.folder, options.places
    analyzer = ["-Xclang", "-analyzer-config", "-Xclang", f"max-nodes={options.steps}"]
    wanted = {path for place in places for path in files_in(os.path.abspath(place)) if path.endswith(".cpp")}
    with open(os.path.join(folder, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    version = subprocess.check_output(["clang-tidy", "--version"], text=True)
    headers = known_headers(folder)
    stamps = Stamps(os.path.join(folder, "tidy.json"))

    def look_at(entry):
        sources = [path for path in sources_of(entry) if path in wanted]
        made_from = headers.get(object_of(entry))
        words = [version, entry["command"], analyzer]
        key = key_of(words, [".clang-tidy"] + sources + made_from) if made_from else None
        if key and stamps.is_good(entry["file"], key):
            return "unchanged", len(sources)
        together = Together(folder, sources)
        command = ["clang-tidy", "--quiet", "--config-file=" + os.path.abspath(".clang-tidy"), together.path, "--"]
        command += flags_of(entry) + analyzer
        ran = subprocess.run(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
        )
        if ran.returncode:
            print(together.name_sources(ran.stdout), end="", flush=True)
        stamps.set(entry["file"], None if ran.returncode else key)
        return "wrong" if ran.returncode else "clean", len(sources)

    # Those of most sources first, so that in the end no processor waits.
    chosen = [entry for entry in entries if wanted & set(sources_of(entry))]
    chosen.sort(key=lambda entry: -len(sources_of(entry)))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        verdicts = list(pool.map(look_at, chosen))
    counts = {word: sum(n for verdict, n in verdicts if verdict == word) for word in ("clean", "wrong", "unchanged")}
    print(f"clang-tidy: {sum(counts.values())} sources: {', '.join(f'{n} {word}' for word, n in counts.items())}")
    sys.exit(counts["wrong"] > 0)


if __name__ == "__main__":
    main()
