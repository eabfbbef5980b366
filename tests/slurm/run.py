#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the README's commands for Slurm on a cluster of one node, this machine, that it starts and ends.

usage: run.py CHECKOUT FOLDER      FOLDER holds anicodec. Exit status 77: skipped, for the reason printed
"""
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue")
SECONDS = 150  # for the jobs
CONFIGURATION = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def recipe(checkout):
    """The block of commands that follows the README's words on Slurm."""
    text = (checkout / "README.md").read_text(encoding="utf-8")
    found = re.search(r"With Slurm.*?```\w*\n(.*?)```", text, re.DOTALL)
    if not found:
        sys.exit("README.md has no commands for Slurm")
    return found[1]


def configure(folder):
    """Files of a cluster in a folder; the environment of its commands."""
    for name in ("state", "spool"):
        (folder / name).mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    text = CONFIGURATION.format(host=socket.gethostname(), controller=free_port(), node=free_port(), folder=folder,
                                cores=len(os.sched_getaffinity(0)))
    (folder / "slurm.conf").write_text(text, encoding="utf-8")
    unified = pathlib.Path("/sys/fs/cgroup/cgroup.controllers").exists()
    (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v2\nIgnoreSystemd=yes\n" if unified else
                                        "CgroupPlugin=cgroup/v1\n", encoding="utf-8")
    return {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}


def wait_for(condition, seconds, what, folder, end_with=sys.exit):
    """Polls until a condition holds; else ends with the logs."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            logs = "\n".join(path.read_text(errors="replace")[-1500:] for path in sorted(folder.glob("*.log")))
            end_with(f"{what} took more than {seconds} seconds\n{logs}")
        time.sleep(0.2)


def start_cluster(folder, environment):
    """Starts the daemons; their processes."""
    places = [f"--{name}={folder}/munge.{name.partition('-')[0]}" for name in
              ("key-file", "socket", "pid-file", "log-file", "seed-file")]
    log = open(folder / "daemons.log", "w", encoding="utf-8")  # noqa: SIM115: theirs

    def start(*command):
        return subprocess.Popen(command, env=environment, cwd=folder, stdout=log, stderr=subprocess.STDOUT)

    daemons = [start("munged", "--foreground", "--force", *places)]
    wait_for((folder / "munge.socket").exists, 20, "starting munged", folder, skip)
    daemons += [start("slurmctld", "-D"), start("slurmd", "-D")]
    return daemons


def output(environment, *command):
    return subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def run_recipe(checkout, folder, environment):
    """Encodes a clip by the README's commands."""
    work = folder / "work"
    work.mkdir()

    def call(*command):
        subprocess.run(command, cwd=work, env=environment, check=True)

    call("anicodec", "corpus", "limb", "-q", "--vertices", "200", "--frame-count", "1500", "-o", "walk.pc2")
    call("bash", "-euo", "pipefail", "-c", recipe(checkout))
    wait_for(lambda: output(environment, "squeue", "-h").strip() == "", SECONDS, "running the jobs", folder)
    if not (work / "walk.anic").exists():
        sys.exit("\n".join(path.read_text(errors="replace") for path in sorted(work.glob("slurm-*.out"))))
    call("anicodec", "verify", "walk.anic")
    told = output({**environment, "PWD": str(work)}, "anicodec", "info", str(work / "walk.anic"))
    if "1500" not in told.replace(" ", ""):
        sys.exit(told)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    checkout, tools = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    os.environ["PATH"] = f"{tools}:{os.environ['PATH']}:/usr/sbin:/sbin"
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        skip(f"{', '.join(missing)} not installed")
    if os.geteuid() != 0:
        skip("slurmd wants to be root")
    with tempfile.TemporaryDirectory(prefix="anicodec_slurm_") as name:
        folder = pathlib.Path(name)
        environment = configure(folder)
        daemons = start_cluster(folder, environment)
        try:
            wait_for(lambda: "idle" in output(environment, "sinfo", "-h"), 60, "starting Slurm", folder, skip)
            run_recipe(checkout, folder, environment)
        finally:
            for daemon in reversed(daemons):
                daemon.terminate()
            for daemon in daemons:
                daemon.wait(timeout=20)


if __name__ == "__main__":
    main()
