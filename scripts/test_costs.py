#!/usr/bin/env python3
"""test_costs.py BUILD [-L REGEX] [-j N] [--top N]: processor seconds of tests, with all processes that they start.

Runs the tests of a build folder as ctest would, and prints the slowest as a table of Markdown and the sum of all. Seconds
of the processor depend less on what else a machine does than those of a clock. Ends with 1 where a test fails.

    scripts/test_costs.py build/release -L '^quick$' --top 20
"""

import argparse
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Dict, List, NamedTuple


class Cost(NamedTuple):
    name: str
    processor: float  # s
    clock: float  # s
    failed: bool


def tests_of(build: str, label: str) -> List[Dict[str, Any]]:
    """As ctest lists them: {"name", "command", "properties"}."""
    words = ["ctest", "--test-dir", build, "--show-only=json-v1", *(("-L", label) if label else ())]
    listed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    tests: List[Dict[str, Any]] = json.loads(listed)["tests"]
    missing = [test["name"] for test in tests if not test.get("command")]
    if missing:
        sys.exit(
            f"test_costs.py: error: {build}: {len(missing)} tests are not built, {missing[0]} for one; build the folder"
        )
    return tests


def names_of(test: Dict[str, Any]) -> List[str]:
    return [entry["name"] for entry in test.get("properties", ())]


def cost_of(test: Dict[str, Any]) -> Cost:
    properties = {entry["name"]: entry["value"] for entry in test.get("properties", ())}
    environment = dict(os.environ)
    environment.update(entry.split("=", 1) for entry in properties.get("ENVIRONMENT", ()))
    # time of bash: TIMEFORMAT gives seconds of the clock, of the program and of the system
    script = 'cd "$1" && shift && TIMEFORMAT="%R %U %S" && { time "$@" >/dev/null 2>&1 </dev/null; } 2>&1; echo $?'
    words = ["bash", "-c", script, "bash", properties.get("WORKING_DIRECTORY", "."), *test["command"]]
    done = subprocess.run(words, env={**environment, "LC_ALL": "C"}, capture_output=True, text=True, check=False)
    clock, user, system, code = map(float, done.stdout.split())
    cost = Cost(test["name"], user + system, clock, code != 0)
    print(f"{cost.processor:8.1f} {cost.name}{' FAILED' if cost.failed else ''}", file=sys.stderr, flush=True)
    return cost


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("build", help="build folder")
    parser.add_argument("-L", dest="label", default="", help="tests whose labels match, as of ctest; without: all")
    parser.add_argument("-j", dest="jobs", type=int, default=1, help="tests at a time")
    parser.add_argument("--top", type=int, default=20, help="rows of the table")
    options = parser.parse_args()
    tests = tests_of(options.build, options.label)
    first = [test for test in tests if "FIXTURES_SETUP" in names_of(test)]  # what others need
    costs = [cost_of(test) for test in first]
    with ThreadPoolExecutor(options.jobs) as pool:
        costs += pool.map(cost_of, (test for test in tests if test not in first))
    costs.sort(key=lambda cost: -cost.processor)
    print("| test | processor seconds |\n|---|---|")
    for cost in costs[: options.top]:
        print(f"| `{cost.name}` | {cost.processor:.1f} |")
    left = costs[options.top :]
    print(f"| {len(left)} others | {sum(cost.processor for cost in left):.0f} |")
    print(f"| all {len(costs)} | {sum(cost.processor for cost in costs):.0f} |")
    failed = [cost.name for cost in costs if cost.failed]
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed or not costs else 0


if __name__ == "__main__":
    sys.exit(main())
