"""Runs a tool and does something to it at a moment that is sure to come, once.

    at_moment.py FOLDER MOMENT DEED COMMAND…

Moments, of the files that COMMAND writes to FOLDER (it has the report for a pipe that nobody reads yet, so that it cannot
end before):
    begun     one of them has its temporary
    written   all is written, and the pipe is waited for
    half      the first has some bytes, not all inputs having been read (no pipe)
Deeds:
    SIGTERM…        that signal, which must be what ends the tool
    shorten:FILE    FILE is cut to a tenth while the tool is stopped; the exit code is the tool's
    remove:FILE     FILE goes
"""

import os
import signal
import subprocess
import sys
import time

folder, moment, deed, *command = sys.argv[1:]


def temporaries(top):
    return [os.path.join(d, f) for d, _, files in os.walk(top) for f in files if f.endswith(".burnish-tmp")]


def size(path):
    try:
        return os.stat(path).st_size
    except FileNotFoundError:
        return 0


def has_come():
    if moment == "begun":
        return temporaries(folder)
    if moment == "half":
        return any(size(f) for f in temporaries(folder))
    return any(size(f) for f in temporaries(os.environ["TMPDIR"]))  # the report, which comes last


if moment != "half":
    os.mkfifo("report")
    command += ["--report", "report"]
tool = subprocess.Popen(command)
deadline = time.monotonic() + 60
while not has_come():
    if tool.poll() is not None or time.monotonic() > deadline:
        tool.kill()
        sys.exit(f"{moment} never came; the tool ended with {tool.wait()}")
if deed.startswith("SIG"):
    number = getattr(signal, deed)
    tool.send_signal(number)
    code = tool.wait()
    if code != -number:
        sys.exit(f"ended with {code} instead of {deed}")
else:
    what, file = deed.split(":")
    tool.send_signal(signal.SIGSTOP)
    os.truncate(file, os.stat(file).st_size // 10) if what == "shorten" else os.remove(file)
    tool.send_signal(signal.SIGCONT)
    sys.exit(tool.wait())
