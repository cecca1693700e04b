#!/usr/bin/env python3
"""Adapters with forbidden behavior; the id of the case selects the behavior."""
import json
import os
import signal
import sys
import time

case = json.load(open(sys.argv[-2]))
result = sys.argv[-1]
mode = case["id"]


def answer(changed=None, **more):
    found = {q["name"]: {"unit": q["unit"], "values": [-100.0]} for q in case["export"]["quantities"]}
    found.update(changed or {})
    text = json.dumps({"status": "solved", "quantities": found,
                       "solver": {"name": "hostile", "version": "1"}, **more})
    with open(result, "w") as file:
        file.write(text)
    return text


def leave_child():
    """Starts a child in a separate session that keeps the output open."""
    if os.fork() == 0:
        os.setsid()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        if os.fork() == 0:
            open("pid", "w").write(str(os.getpid()))
            time.sleep(1000)
        os._exit(0)
    while not os.path.exists("pid") or not open("pid").read():
        time.sleep(0.01)


if mode == "never-returns":
    leave_child()
    time.sleep(1000)
elif mode == "leaves-children":
    leave_child()
    answer()
elif mode == "fills-the-disk":
    while True:
        open("file-%d" % time.time_ns(), "wb").write(bytes(1 << 20))
elif mode == "writes-ten-gigabytes":
    with open(result, "wb") as file:
        for _ in range(10240):
            file.write(b"1" * (1 << 20))
elif mode == "takes-memory":
    hoard = bytearray(10 << 30)
    hoard[::4096] = b"1" * len(hoard[::4096])
elif mode == "writes-half-a-json":
    text = answer()
    open(result, "w").write(text[:len(text) // 2])
elif mode == "says-nan":
    text = answer()
    open(result, "w").write(text.replace("-100.0", "NaN"))
elif mode == "says-infinity":
    text = answer()
    open(result, "w").write(text.replace("-100.0", "1e999"))
elif mode == "other-unit":
    answer({"reaction_y_N:A": {"unit": "kN", "values": [0.1]}})
elif mode == "other-length":
    answer({"frequency_Hz": {"unit": "Hz", "values": [1.0]}})
elif mode == "longer":
    answer({"frequency_Hz": {"unit": "Hz", "values": [1.0, 2.0, 3.0, 4.0]}})
elif mode == "other-name":
    answer({"reaction_y:A": {"unit": "N", "values": [-100.0]}})
elif mode == "other-key":
    answer(verdict="pass")
elif mode == "prints-much":
    for _ in range(2000):
        print("x" * 10000)
    answer()
elif mode == "prints-for-ever":
    while True:
        print("x" * 10000)
elif mode == "dies":
    os.kill(os.getpid(), signal.SIGSEGV)
elif mode == "fails":
    sys.exit("the license has expired")
elif mode == "says-nothing":
    pass
elif mode == "links-to-zeros":
    os.symlink("/dev/zero", result)
elif mode == "makes-a-pipe":
    os.mkfifo(result)
elif mode == "removes-its-folder":
    import shutil
    shutil.rmtree(os.getcwd())
elif mode == "cannot":
    json.dump({"status": "cannot", "reason": "no beams"}, open(result, "w"))
    sys.exit(4)
elif mode == "cannot-say-why":
    sys.exit(4)
elif mode == "gives-nothing":
    json.dump({"status": "solved"}, open(result, "w"))
elif mode == "beam-cantilever":  # returns exact frequencies plus an error of order argv[1] in the element size h
    level = case["export"].get("level")
    h = 1 / (32 if level is None else 2**level)
    roots = (1.875104068711961, 4.694091132974175, 7.854757438237613, 10.995540734875467,
             14.137168391046471, 17.278759532088236)
    wave = 0.01 * (6.9e10 / 2700 / 12) ** 0.5 / (2 * 3.141592653589793)
    values = [r * r * wave * (1 + 0.01 * h ** float(sys.argv[1])) for r in roots]
    answer({"frequency_Hz": {"unit": "Hz", "values": values}},
           solver={"name": "of that order", "element_order": json.loads(sys.argv[2])},
           status="not-converged" if level is not None and "--no-level-converges" in sys.argv else "solved")
elif mode == "is-off":
    answer({"reaction_y_N:A": {"unit": "N", "values": -103.0}})
else:
    answer()
