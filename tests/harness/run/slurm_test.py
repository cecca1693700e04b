#!/usr/bin/env python3
"""Tests shards with a real Slurm: munge, slurmctld and two slurmd on this machine. One slurmd dies during the run.

Argument: the program. Submits the output of `trammel slurm`, kills a node with all its processes after the first results, and
compares the merged results with those of one call. The exit status is 77 if Slurm is not installed."""
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

CASES = ["cooks-membrane", "tracking-exact"]
SHARDS = 4

CONFIGURATION = """
ClusterName=trammel
SlurmctldHost={host}
SlurmUser=root
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldPort={port}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SlurmdTimeout=5
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{first}-{last}] CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n[1-2] Default=YES
"""


class Cluster:
    """Slurm cluster with two nodes on this machine; its daemons run in separate sessions."""

    def __init__(self, folder):
        self.folder, self.processes = folder, {}
        for name in ("munge", "state"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        port = 20000 + os.getpid() % 10000
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=folder, host=socket.gethostname().split(".")[0], port=port, first=port + 1, last=port + 2))
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        self.start("munge", "munged", "--foreground", "--force", f"--key-file={key}",
                   *(f"--{what}={folder}/munge/{what}" for what in ("socket", "log-file", "pid-file", "seed-file")))
        self.start("slurmctld", "slurmctld", "-D")
        for node in ("n1", "n2"):
            self.start(node, "slurmd", "-D", "-N", node)

    def start(self, name, *words):
        with open(self.folder / f"{name}.log", "w") as log:
            self.processes[name] = subprocess.Popen(words, stdout=log, stderr=log, start_new_session=True)

    def kill(self, name):
        """Kills the daemon, its step daemons, which have detached, and all their processes at once."""
        if self.processes[name].poll() is not None:
            return
        family = {self.processes[name].pid}
        mark = f"SLURMD_NODENAME={name}".encode()
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if mark not in (entry / "environ").read_bytes().split(b"\0"):
                    continue
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                family.add(int(entry.name))
                if "slurmstepd" in pathlib.Path(f"/proc/{parent}/cmdline").read_text():
                    family.add(parent)
            except OSError:
                continue
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for process in family:
                try:
                    os.kill(process, number)
                except ProcessLookupError:
                    continue
        self.processes[name].wait()

    def stop(self):
        for name in reversed(list(self.processes)):
            self.kill(name)


def said(*words):
    return subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def wait_for(what, condition, limit_s):
    end = time.monotonic() + limit_s
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"{what}: not within {limit_s} s")
        time.sleep(0.2)


def numbers(out):
    """Returns the results without times, date and the number of stored runs, which includes all runs after a merge."""
    results = json.loads((out / "results.json").read_text())
    for key in ("date", "stored_runs"):
        results["environment"].pop(key, None)
    for run in results["runs"]:
        run["cost"] = run["cost"].get("counters")
    return results


def kept(out, shard="*"):
    return len(list(out.glob(f"shard-{shard}/store/*.cbor")))


def lose_a_node(cluster, out):
    """Kills the node of a running shard. @returns the number of the shard"""
    wait_for("first results", lambda: kept(out) >= 2, 120)
    shard, node = said("squeue", "-h", "-r", "-t", "R", "-o", "%K %N").splitlines()[0].split()
    cluster.kill(node)
    print(f"{kept(out)} runs kept, {kept(out, shard)} of shard {shard}, whose node {node} dies", flush=True)
    return shard


def main():
    program = sys.argv[1]
    if not all(shutil.which(name) for name in ("munged", "slurmctld", "slurmd", "sbatch")):
        print("Slurm is not installed (packages slurm-wlm and munge)")
        return 77
    with tempfile.TemporaryDirectory(prefix="trammel-slurm-") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)
        whole, out, script = folder / "whole", folder / "out", folder / "job.sh"
        subprocess.run([program, "run", *CASES, "--out", str(whole)], stdout=subprocess.DEVNULL, check=True)
        script.write_text(said(program, "slurm", "--shards", str(SHARDS), *CASES, "--jobs", "1", "--out",
                               str(out)))
        cluster = Cluster(folder)
        try:
            wait_for("two idle nodes", lambda: said("sinfo", "-h", "-o", "%D %T") == "2 idle", 60)
            print(said("sh", str(script)))
            shard = lose_a_node(cluster, out)
            requeued = lambda: said("squeue", "-h", "-r", "-t", "PD", "-o", "%K %r").split("\n").count(f"{shard} BeginTime")
            wait_for(f"shard {shard} in the queue again", requeued, 60)
            job = said("squeue", "-h", "-r", "-t", "PD", "-o", "%A %K %r").split("\n")
            for line in job:  # restarts the job at once; by default Slurm waits two minutes
                if line.endswith(f" {shard} BeginTime"):
                    said("scontrol", "update", f"JobId={line.split()[0]}", "StartTime=now")
            wait_for("an empty queue", lambda: not said("squeue", "-h", "-o", "%i"), 300)
            if not (out / "merge.log").exists():
                sys.exit("expected the merging job to run: " + (cluster.folder / "slurmctld.log").read_text())
            print(f"shard {shard}'s log: " + (out / f"shard-{shard}.log").read_text().strip())
            print("the merge's log: " + (out / "merge.log").read_text().strip())
        finally:
            cluster.stop()
        compared = said(program, "compare", str(whole / "results.json"), str(out / "results.json"))
        print(compared)
        equal = numbers(whole) == numbers(out) and ", 0 differ" in compared
        print("merged results equal those of one call" if equal else "merged results differ")
        return 0 if equal else 1


if __name__ == "__main__":
    sys.exit(main())
