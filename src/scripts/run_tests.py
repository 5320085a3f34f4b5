#!/usr/bin/env python3
"""Runs the tests that a build folder's CTest knows, many tests of a program in one process.

A program of OpenGL or of the sanitizers starts for about a second, and there are thousands of tests: CTest starts a
process for each. Here a process runs a batch of them. What CTest says of a test holds: its label, its environment, and
its timeout. Where a test ends its process, it has failed, and a new process goes on with the test after it. Tests that
are no GoogleTest are left to CTest.

A program none of whose tests failed is not run again, but for the tests that were skipped, until it changes, or
something that it reads (lkao_test's READS), or what it runs on: packages, shared scenes, variables of the environment.
The same holds for a test that is no GoogleTest, but a program of the build and nothing else, or that says what it hangs
on: CTest's REQUIRED_FILES. What CTest runs before it goes with it. --all runs them all the same.

Writes "PASSED FAILED SKIPPED" as numbers into the file REPORT, then a line for each failed test, each skipped one, and
one for the programs that were not run again. The exit status is 0 unless the tests could not be run.
"""

import argparse
import concurrent.futures
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as xml

from stamps import Stamps, key_of
from test_inputs import program_key, surroundings

LARGEST_BATCH = 100
FILTER = "--gtest_filter="
FIXTURES = ("FIXTURES_SETUP", "FIXTURES_REQUIRED")


class Test:
    """A test as CTest knows it."""

    def __init__(self, entry):
        self.name = entry["name"]
        self.command = entry.get("command", [])
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.labels = properties.get("LABELS", [])
        self.timeout = properties.get("TIMEOUT", 1500)
        self.environment = properties.get("ENVIRONMENT", [])
        self.folder = properties.get("WORKING_DIRECTORY")
        self.cost = properties.get("COST", 0)
        self.fixtures = {name for kind in FIXTURES for name in properties.get(kind, [])}
        self.reads = properties.get("REQUIRED_FILES", [])
        filters = [i for i, argument in enumerate(self.command) if argument.startswith(FILTER)]
        # What GoogleTest calls the test: CTest's name has the values of its parameters.
        self.filter = self.command[filters[0]][len(FILTER) :] if filters else None
        self.start = self.command[: filters[0]] if filters else self.command
        self.end = self.command[filters[0] + 1 :] if filters else []

    @property
    def program(self):
        return self.start[-1]  # behind an emulator


class Results:
    """What became of the tests; several threads add to it."""

    def __init__(self):
        self.lock = threading.Lock()
        self.passed = 0
        self.failed = []
        self.skipped = []
        self.failed_programs = set()
        self.skipped_by = {}  # the names of a program's skipped tests

    def is_good(self, name):
        return f"FAILED  {name}" not in self.failed and not any(s.startswith(f"SKIPPED {name}:") for s in self.skipped)

    def add(self, program, passed=0, failed=(), skipped=()):
        with self.lock:
            self.passed += passed
            self.failed += [f"FAILED  {name}" for name in failed]
            self.skipped += [f"SKIPPED {name}: {reason}" for name, reason in skipped]
            if failed:
                self.failed_programs.add(program)
            self.skipped_by.setdefault(program, []).extend(name for name, _ in skipped)


class Process:
    """One process that runs some tests of a program."""

    running = set()  # groups of processes

    def __init__(self, tests):
        self.tests = tests
        self.passed = 0
        self.failed = []
        self.skipped = []
        self.output = []  # of failed tests
        self.left = []  # tests that were not reached

    def run(self):
        first = self.tests[0]
        arguments = first.start + [FILTER + ":".join(test.filter for test in self.tests)] + first.end
        environment = dict(os.environ, **dict(pair.split("=", 1) for pair in first.environment))
        process = subprocess.Popen(
            arguments,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env=environment,
            cwd=first.folder,
            start_new_session=True,
        )
        self.running.add(process.pid)
        waiting = {test.filter: test for test in self.tests}
        current = None
        lines = []
        timer = self.timer(process, first)
        for line in process.stdout:
            lines.append(line)
            begun = re.match(r"\[ RUN      \] (\S+)$", line)
            if begun and begun[1] in waiting:
                current = waiting.pop(begun[1])
                timer.cancel()
                timer = self.timer(process, current)
                lines = [line]
            elif current and (outcome := self.outcome(line, current)):
                self.note(outcome, current, lines)
                current = None
                lines = []
        timer.cancel()
        status = process.wait()
        self.running.discard(process.pid)
        if current:
            lines.append(f"the test ended its process (exit status {status}) or ran out of its {current.timeout:g} s\n")
            self.note("FAILED", current, lines)
            self.left = list(waiting.values())
        elif waiting or (status != 0 and not self.failed):
            # It ended before its first test or between two, or, as after a leak, when all of them had passed.
            at_end = f"{os.path.basename(first.program)} at its end: {self.reason(lines, status)}"
            self.failed += [test.name for test in waiting.values()] or [at_end]
            self.output += lines + [f"exit status {status}\n"]

    @staticmethod
    def reason(lines, status):
        """What a sanitizer says it was, for the list of failures: the output above it may be cut off."""
        reports = [line.strip() for line in lines if "Sanitizer" in line]
        return f"exit status {status}" + (f", {reports[-1]}" if reports else "")

    @staticmethod
    def timer(process, test):
        timer = threading.Timer(test.timeout, os.killpg, (process.pid, signal.SIGKILL))
        timer.daemon = True
        timer.start()
        return timer

    @staticmethod
    def outcome(line, test):
        # Not at the beginning of the line where the test's own last line has no end.
        match = re.search(r"\[ +(OK|FAILED|SKIPPED) +\] " + re.escape(test.filter) + r"(,| \()", line)
        return match and match[1]

    def note(self, outcome, test, lines):
        if outcome == "OK":
            self.passed += 1
        elif outcome == "SKIPPED":
            reason = re.search(r": Skipped\n(.*)", "".join(lines))
            self.skipped.append((test.name, reason[1] if reason else "no reason given"))
        else:
            self.failed.append(test.name)
            self.output += lines


def run_batch(tests, results):
    """Runs tests of one program, in a new process after each that ends its own."""
    program = tests[0].program
    while tests:
        start = time.monotonic()
        process = Process(tests)
        process.run()
        results.add(program, process.passed, process.failed, process.skipped)
        counts = f"{process.passed} passed, {len(process.failed)} failed, {len(process.skipped)} skipped"
        heading = f"{time.monotonic() - start:7.1f} s  {os.path.basename(program)}: {counts}\n"
        print(heading + "".join(process.output), end="", flush=True)
        tests = process.left


def run_by_ctest(folder, tests, results):
    """Runs tests that are no GoogleTest, and what CTest must run before them."""
    report = os.path.join(os.path.abspath(folder), "ctest.xml")
    names = "^(" + "|".join(re.escape(test.name) for test in tests) + ")$"
    command = ["ctest", "--test-dir", folder, "--output-on-failure", "--no-tests=error", "--output-junit", report]
    subprocess.run(command + ["-R", names], check=False)
    for case in xml.parse(report).getroot().iter("testcase"):
        skip = case.find("skipped")
        # Tests that were not built, or that lack a fixture, are marked as skipped too, with other messages.
        if skip is not None and skip.get("message", "").startswith("SKIP_"):
            reason = re.search(r": Skipped\n(.*)", case.findtext("system-out") or "")
            results.add(None, skipped=[(case.get("name"), reason[1] if reason else "no reason given")])
        elif skip is not None or case.find("failure") is not None:
            results.add(None, failed=[case.get("name")])
        else:
            results.add(None, passed=1)


def known_tests(folder, label, left_out):
    listing = subprocess.check_output(["ctest", "--test-dir", folder, "--show-only=json-v1"])
    tests = [Test(entry) for entry in json.loads(listing)["tests"]]
    return [t for t in tests if (label is None or label in t.labels) and left_out not in t.labels]


def stop(*_):
    """The processes are in groups of their own, which a terminal does not interrupt."""
    for group in list(Process.running):
        os.killpg(group, signal.SIGKILL)
    os._exit(130)


def batches_of(tests):
    """As few as may be, of the same size: what a program makes for all its tests it makes again in each."""
    count = -(-len(tests) // LARGEST_BATCH)
    return [tests[len(tests) * i // count : len(tests) * (i + 1) // count] for i in range(count)]


def groups_of(tests):
    """Tests of which CTest runs some for the others, together."""
    groups = []  # tests and their fixtures
    for test in tests:
        joined = [group for group in groups if group[1] & test.fixtures]
        groups = [group for group in groups if group not in joined]
        groups.append((sum((group[0] for group in joined), []) + [test], test.fixtures.union(*(g[1] for g in joined))))
    return [group[0] for group in groups]


def key_of_other(folder, test, around):
    """Of a test that is no GoogleTest; none where it does not say what it hangs on."""
    words = [test.command, test.environment, test.reads]
    if test.reads:
        return key_of([words, around], test.reads)
    is_program = test.command and test.command[0].startswith(os.path.abspath(folder) + os.sep)
    return program_key(test.command[0], words, around) if is_program and not test.fixtures else None


def skips_of(program):
    """Under which name the stamps have the skipped tests of a program."""
    return program + " skips"


def main():
    parser = argparse.ArgumentParser(description="Runs the tests that a build folder's CTest knows.")
    parser.add_argument("folder")
    parser.add_argument("report")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--label", help="only tests with this label")
    parser.add_argument("--leave-out", help="no tests with this label")
    parser.add_argument("--all", action="store_true", help="also programs that passed and have not changed")
    options = parser.parse_args()

    tests = known_tests(options.folder, options.label, options.leave_out)
    if not tests:
        sys.exit(f"run_tests: {options.folder} has no such tests")
    programs = {}
    for test in tests:
        if test.filter:
            programs.setdefault(test.program, []).append(test)
    others = [test for test in tests if not test.filter]

    stamps = Stamps(os.path.join(options.folder, "passed.json"))
    around = surroundings(options.folder)
    results = Results()
    unchanged = []
    keys = {}
    for program, its_tests in list(programs.items()):
        keys[program] = program_key(program, [[test.command, test.environment] for test in its_tests], around)
        if not options.all and stamps.is_good(program, keys[program]):
            programs[program] = [test for test in its_tests if test.name in stamps.keys.get(skips_of(program), [])]
            passed_before = len(its_tests) - len(programs[program])
            unchanged.append(f"{os.path.basename(program)} ({passed_before})")
            results.add(program, passed=passed_before)

    other_keys = {test.name: key_of_other(options.folder, test, around) for test in others}
    for group in groups_of(others):
        known = [(test.name, other_keys[test.name]) for test in group if other_keys[test.name]]
        if not options.all and len(known) == len(group) and all(stamps.is_good(*pair) for pair in known):
            others = [test for test in others if test not in group]
            unchanged.append(f"{group[0].name} ({len(group)})")
            results.add(None, passed=len(group))

    signal.signal(signal.SIGINT, stop)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        work = []
        if others:
            work.append(pool.submit(run_by_ctest, options.folder, others, results))
        # Those that take long first, so that in the end no processor waits.
        for its_tests in sorted(filter(None, programs.values()), key=lambda of_one: -of_one[0].cost):
            work += [pool.submit(run_batch, batch, results) for batch in batches_of(its_tests)]
        for done in concurrent.futures.as_completed(work):
            done.result()

    for program in programs:
        stamps.set(skips_of(program), results.skipped_by.get(program, []))
        stamps.set(program, keys[program] if program not in results.failed_programs else None)
    for name, key in other_keys.items():
        stamps.set(name, key if results.is_good(name) else None)
    with open(options.report, "w", encoding="utf-8") as report:
        print(results.passed, len(results.failed), len(results.skipped), file=report)
        for line in results.failed + results.skipped:
            print(line, file=report)
        if unchanged:
            print(f"UNCHANGED in {options.folder}, passed before, not run again: {', '.join(unchanged)}", file=report)


if __name__ == "__main__":
    main()
