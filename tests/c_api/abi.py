#!/usr/bin/env python3
"""abi.py HEADERS CC LIBRARY HOST LIST [--update]: the binary interface of liblkao_c is what LIST says.

Of the headers: every function with its arguments, every type, number of an enumeration and struct; of a program that
the compiler CC makes of them: the sizes of the structs and where their members lie; of LIBRARY: the names that it
exports. HOST, the object of a program in C, calls every function. LIST only grows: a line of it that changes or goes
breaks programs that exist, and needs another LKAO_C_ABI.
"""

import difflib
import pathlib
import re
import subprocess
import sys
import tempfile


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def functions_of(text):
    return [" ".join(found.split()) for found in re.findall(r"LKAO_C_API ([^#;]*\));", text)]


def numbers_of(text):
    enumerators = re.findall(r"\b(LKAO_\w+) = (\d+)", text)
    return [f"{name} = {value}" for name, value in enumerators + re.findall(r"#define (LKAO_C_ABI) (\d+)", text)]


def types_of(text):
    return [" ".join(found.split()) for found in re.findall(r"typedef ([^{;]*);", text)]


def structs_of(text):
    """Each struct's name, and those of its members."""
    structs = re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.DOTALL)
    return [(name, re.findall(r"(\w+)(?:\[\w+\])?;", members)) for name, members in structs]


def layouts_of(structs, headers, compiler):
    lines = ["#include <stddef.h>", "#include <stdio.h>", "#include <lkao/c.h>", "int main(void) {"]
    for name, members in structs:
        lines.append(f'  printf("{name} %d:", (int)sizeof({name}));')
        lines += [f'  printf(" {member} %d", (int)offsetof({name}, {member}));' for member in members]
        lines.append('  printf("\\n");')
    lines += ["  return 0;", "}"]
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder, "layouts.c"), pathlib.Path(folder, "layouts")
        source.write_text("\n".join(lines) + "\n", encoding="utf-8")
        subprocess.run([compiler, "-std=c99", "-I", headers, "-o", program, source], check=True)
        return subprocess.check_output([program], text=True).splitlines()


def names_in(file, *options):
    listing = subprocess.check_output(["nm", *options, file], text=True)
    return {name for name in re.findall(r"(\S+)$", listing, re.MULTILINE)}


def main():
    headers, compiler, library, host, expected_path = sys.argv[1:6]
    files = sorted(pathlib.Path(headers, "lkao", "c").glob("*.h"))
    text = without_comments("\n".join(path.read_text(encoding="utf-8") for path in files))
    functions = functions_of(text)
    names = {re.search(r"(\w+)\(", function)[1] for function in functions}
    problems = []
    exported = names_in(library, "-D", "--defined-only")
    problems += [f"declared, but not exported: {name}" for name in sorted(names - exported)]
    problems += [f"exported, but not declared: {name}" for name in sorted(exported - names)]
    uncalled = sorted(names - names_in(host, "--undefined-only"))
    problems += [f"not called by the host in C: {name}" for name in uncalled]

    sections = {
        "functions": sorted(functions),
        "types": types_of(text),
        "numbers": numbers_of(text),
        "structs: bytes, and where members begin": layouts_of(structs_of(text), headers, compiler),
    }
    actual = "".join(f"# {title}\n" + "\n".join(lines) + "\n" for title, lines in sections.items())
    if sys.argv[6:] == ["--update"]:
        pathlib.Path(expected_path).write_text(actual, encoding="utf-8")
    expected = pathlib.Path(expected_path).read_text(encoding="utf-8")
    problems += difflib.unified_diff(expected.splitlines(), actual.splitlines(), "promised", "found", lineterm="", n=0)
    if problems:
        print("\n".join(problems))
        print("Additions belong into the list: abi.py ... --update (CONTRIBUTING.md). Anything else breaks programs.")
        sys.exit(1)
    counts = ", ".join(f"{len(lines)} {title.split(':')[0]}" for title, lines in sections.items())
    print(f"the binary interface is what was promised: {counts}")


if __name__ == "__main__":
    main()
