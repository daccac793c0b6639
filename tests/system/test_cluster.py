#!/usr/bin/env python3
"""The program from outside: planned trials carried out by Slurm and by MPI, which give the same table as a sweep on this machine.

Slurm is set up here on one node with daemons of its own, all in a temporary folder; that needs root and Debian's slurmctld, slurmd, slurm-client
and munge. Without them, or where they cannot start, the test is skipped and says why.
"""
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

import case
from small_sweep import sweep

SLURM_CONF = """\
ClusterName=proveta
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ctld}
SlurmdPort={d}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmctldTimeout=10
SlurmdTimeout=10
KillWait=2
MinJobAge=300
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(n):
    sockets = [socket.socket() for _ in range(n)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Slurm:
    """A Slurm of one node while the context lasts. Raises SkipTest when it cannot be had here."""

    TOOLS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo"]

    def __enter__(self):
        path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
        self.tools = {tool: shutil.which(tool, path=path) for tool in self.TOOLS}
        missing = [tool for tool, at in self.tools.items() if at is None]
        if missing:
            raise unittest.SkipTest("not installed: " + ", ".join(missing))
        if os.geteuid() != 0:
            raise unittest.SkipTest("Slurm's daemons need root here")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="proveta_slurm_"))
        self.daemons = []
        try:
            self.set_up()
        except BaseException:
            self.__exit__()
            raise
        return self

    def set_up(self):
        self.folder.chmod(0o755)
        for name in ["state", "spool"]:
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        ctld, d = free_ports(2)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(SLURM_CONF.format(host=host, ctld=ctld, d=d, folder=self.folder, cpus=os.cpu_count()))
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                    f"--seed-file={self.folder}/munged.seed", f"--log-file={self.folder}/munged.file.log")
        self.wait("munged", lambda: (self.folder / "munge.socket").exists())
        self.daemon("slurmctld", "-D", "-i")
        self.daemon("slurmd", "-D")
        self.wait("slurmd", lambda: self.call("sinfo", "-h", "-o", "%T").stdout.strip() == "idle")

    def daemon(self, name, *arguments):
        with open(self.folder / f"{name}.log", "w") as log:
            self.daemons.append(subprocess.Popen([self.tools[name], *arguments], stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=self.environment))

    def wait(self, name, ready, at_most=30.0):
        end = time.monotonic() + at_most
        while not ready():
            if time.monotonic() > end or any(daemon.poll() is not None for daemon in self.daemons):
                logs = [(self.folder / f"{n}.log").read_text().strip().splitlines()[-3:] for n in ("munged", "slurmctld", "slurmd") if (self.folder / f"{n}.log").exists()]
                raise unittest.SkipTest(f"{name} does not start here: {logs}")
            time.sleep(0.1)

    def call(self, tool, *arguments, **options):
        return subprocess.run([self.tools[tool], *map(str, arguments)], capture_output=True, text=True, env={**self.environment, **options.pop("env", {})}, timeout=30, **options)

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Cluster(case.Case):
    def plan(self):
        """A planned sweep; returns its file."""
        file = self.deck(sweep(points=4), "sweep.json")
        done = self.run_program("sweep", file, "--out", "there", "--plan", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return file

    def check_collected(self, file):
        done = self.run_program("sweep", file, "--out", "there", "--collect", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        here = self.run_program("sweep", file, "--out", "here", "--quiet")
        self.assertEqual(here.returncode, 0, here.stderr)
        self.assertEqual((self.folder / "there" / "table.csv").read_bytes(), (self.folder / "here" / "table.csv").read_bytes())
        self.assertEqual([r["status"] for r in self.rows(self.folder / "here" / "table.csv")], ["complete"] * 4)

    def test_slurm_array(self):
        with Slurm() as slurm:
            file = self.plan()
            done = slurm.call("sbatch", "--array=1-4", self.folder / "there" / "slurm.sh", cwd=self.folder, env={"PROVETA": case.PROGRAM})
            self.assertEqual(done.returncode, 0, done.stderr)
            end = time.monotonic() + 120
            while slurm.call("squeue", "-h").stdout.strip() and time.monotonic() < end:
                time.sleep(0.2)
            logs = sorted(self.folder.glob("slurm-*.log"))
            self.assertEqual(len(logs), 4, "one task a trial")
            self.assertEqual([log.read_text() for log in logs], [""] * 4)
            self.check_collected(file)

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def test_mpi(self):
        file = self.plan()
        as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        done = subprocess.run([str(self.folder / "there" / "mpi.sh"), "--oversubscribe", *as_root], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "N": "2", "PROVETA": case.PROGRAM}, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_collected(file)


if __name__ == "__main__":
    case.main()
