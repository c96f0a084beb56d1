"""Summary of a JUnit file by ctest: prints what failed, with its output, and what was skipped, with the reason.

Usage: summary.py FILE. "passed failed skipped" goes to file descriptor 3.
"""

import os
import re
import sys
import xml.etree.ElementTree as xml

passed = failed = skipped = 0
for case in xml.parse(sys.argv[1]).getroot().iter("testcase"):
    output = case.findtext("system-out") or ""
    not_run = case.find("skipped")
    if case.get("status") == "run":
        passed += 1
    elif not_run is not None and not_run.get("message").startswith("SKIP_"):
        skipped += 1
        # GoogleTest prints "file:line: Skipped" and then the reason, our scripts "SKIPPED: reason".
        reason = re.search(r"(?:: Skipped\n|SKIPPED: )(.+)", output)
        print("SKIPPED", case.get("name") + ":", reason.group(1) if reason else "no reason was given")
    else:
        failed += 1
        print("FAILED", case.get("name"), output[-4000:], sep="\n")
os.write(3, f"{passed} {failed} {skipped}".encode())
