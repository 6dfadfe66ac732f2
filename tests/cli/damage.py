#!/usr/bin/env python3
"""Damaged result folders and input files against the program: it answers each with one of its exit codes, within 30 s of CPU time and 2 GB, and writes
nowhere but where it is told to; verify passes no folder of which a file has changed.

    damage.py PROGRAM SOURCE_FOLDER SCRATCH_FOLDER [--count 500] [--seed 1] [--only NUMBER]

The damage of a number and a seed is the same on every machine. --only repeats one and leaves its files in SCRATCH_FOLDER."""
import argparse
import collections
import hashlib
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time

CPU_SECONDS, WALL_SECONDS, LARGEST_RSS = 30, 240, 2 << 30
CODES = {0, 2, 3}
CASE = """title = "Damaged"
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = {domain}
chart = ["x", "y", "0.035"]
[[support]]
boundary = "{edge}"
fix = ["u", "r"]
[[load]]
force = [0, 0, -4e-4]
[mesh]
refinements = 1
[[probe]]
name = "middle"
at = [0.5, 0.5]
[[line]]
name = "across"
through = [[0, 0.5], [1, 0.5]]
points = 5
{more}"""
RECTANGLE = "{ rectangle = { to = [1, 1], cells = [2, 2] } }"
FLOOR = '[[obstacle]]\nname = "floor"\nhalf_space = { point = [0, 0, 0], normal = [0, 0, 1] }\n'
BALL = '[[obstacle]]\nname = "ball"\nball = { centre = [0.5, 0.5, -1], radius = 1 }\n'
STEPS = '[[step]]\nname = "up"\nparts = 2\n[[step.move]]\nobstacle = "ball"\ntranslate = [0, 0, 0.002]\n'
HARD = ["nan", "-inf", "1e308", "-1e308", "1e-308", "6.5e-319", "0", "-1", "0.5", "1e30", "99999999999999999999", "-0.0", "x", "\"x\"", "[]", "{}", "null",
        "2147483648", "-2147483649", "1000000000", "0.001", "7"]


def case_text(domain=RECTANGLE, edge="left", more=FLOOR):
    return CASE.replace("{domain}", domain).replace("{edge}", edge).replace("{more}", more)


# ---- input files -----------------------------------------------------------------------------------------------------------

def box_surface():
    """Points and triangles of the box from (0, 0, -0.5) to (1, 1, 0), each face divided."""
    points, triangles, number = [], [], {}

    def point(p):
        if p not in number:
            number[p] = len(points)
            points.append(p)
        return number[p]
    low, high, n = (0.0, 0.0, -0.5), (1.0, 1.0, 0.0), 3
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (low, high):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0.0, 0.0, 0.0]
                        p[axis] = end[axis]
                        p[u] = low[u] + (high[u] - low[u]) * (i + a) / n
                        p[v] = low[v] + (high[v] - low[v]) * (j + b) / n
                        corners.append(point(tuple(p)))
                    if end is low:
                        corners.reverse()
                    triangles += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
    return points, triangles


def surface_files():
    points, triangles = box_surface()
    text = "solid box\n"
    binary = b"\0" * 80 + struct.pack("<I", len(triangles))
    for t in triangles:
        text += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % points[k] for k in t) + "endloop\nendfacet\n"
        binary += struct.pack("<12fH", 0, 0, 0, *points[t[0]], *points[t[1]], *points[t[2]], 0)
    obj = "".join("v %.9g %.9g %.9g\n" % p for p in points) + "".join("f %d %d %d\n" % tuple(k + 1 for k in t) for t in triangles)
    head = ("ply\nformat %%s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face %d\n"
            "property list uchar int vertex_indices\nend_header\n" % (len(points), len(triangles)))
    ply = head % "ascii" + "".join("%.9g %.9g %.9g\n" % p for p in points) + "".join("3 %d %d %d\n" % t for t in triangles)
    bytes_ply = (head % "binary_little_endian").encode() + b"".join(struct.pack("<3f", *p) for p in points) + b"".join(
        struct.pack("<B3i", 3, *t) for t in triangles)
    return {"text.stl": (text + "endsolid box\n").encode(), "binary.stl": binary, "box.obj": obj.encode(), "text.ply": ply.encode(), "binary.ply": bytes_ply}


def raster_file():
    rows = "\n".join(" ".join("%.5f" % (0.003 * ((i * j) % 3)) for i in range(9)) for j in range(9))
    return ("ncols 9\nnrows 9\nxllcorner -0.5\nyllcorner -0.5\ncellsize 0.25\nNODATA_value -9999\n" + rows + "\n").encode()


def input_cases(source):
    """Name of a file -> its bytes and the case that reads it."""
    cases = {}
    for name, data in surface_files().items():
        cases[name] = data, case_text(more='[[obstacle]]\nname = "box"\nsurface = "%s"\n' % name)
    cases["floor.asc"] = raster_file(), case_text(more='[[obstacle]]\nname = "floor"\nheight_field = { file = "floor.asc" }\n')
    square = (source / "tests/cli/wrong/square.msh").read_bytes()
    cases["square.msh"] = square, case_text('{ mesh = "square.msh" }', "edge")
    sector = case_text('{ mesh = "sector.msh" }', "flat sides").replace("at = [0.5, 0.5]", "at = [1, 1]").replace(
        "[[0, 0.5], [1, 0.5]]", "[[1, 0.5], [1, 1.2]]")
    cases["sector.msh"] = (source / "tests/domain/data/quarter-annulus-4.1.msh").read_bytes(), sector
    return cases


# ---- damage ------------------------------------------------------------------------------------------------------------------

def damaged(data, chance):
    for _ in range(chance.randint(1, 3)):
        kind = chance.randrange(7)
        at = chance.randrange(len(data) + 1)
        length = min(len(data) - at, chance.choice([1, 8, 40, 400]))
        if kind == 0 and data:
            at = chance.randrange(len(data))
            data = data[:at] + bytes([data[at] ^ (1 << chance.randrange(8))]) + data[at + 1:]
        elif kind == 1:
            data = data[:at]
        elif kind == 2:
            data = data[:at] + data[at + length:]
        elif kind == 3:
            data = data[:at] + bytes(chance.randrange(256) for _ in range(chance.choice([1, 8, 100]))) + data[at:]
        elif kind == 4:
            data = data[:at] + data[at:at + length] * chance.choice([2, 50]) + data[at + length:]
        elif kind == 5:
            data = data[:at] + b"\0" * length + data[at + length:]
        else:
            numbers = list(re.finditer(rb"-?[0-9][0-9.eE+-]*", data[:200000]))
            if numbers:
                number = chance.choice(numbers)
                data = data[:number.start()] + chance.choice(HARD).encode() + data[number.end():]
    return data


def damaged_doubles(data, chance):
    """One of the numbers of solution.plastron, in all its places."""
    at = 72 + 8 * chance.randrange((len(data) - 72) // 8)
    old, new = data[at:at + 8], struct.pack("<d", chance.choice([0, 6.5e-319, 0.5, -1, 1e30, 1e60, 1e308, float("nan"), float("inf"), 1e-3]))
    return data.replace(old, new) if old != b"\0" * 8 else data[:at] + new + data[at + 8:]


def damage_folder(folder, canary, chance):
    """Names of the files that were changed."""
    names = sorted(path.name for path in folder.iterdir())
    for _ in range(chance.choice([1, 1, 1, 2, 4])):
        path = folder / chance.choice(names + ["results.json", "solution.plastron"] * 3)
        kind = chance.randrange(12)
        if not path.is_file() or path.is_symlink():
            continue
        data = path.read_bytes()
        if kind < 7:
            damage = damaged_doubles if path.name == "solution.plastron" and len(data) > 100 and chance.randrange(2) else damaged
            path.write_bytes(damage(data, chance))
            continue
        path.unlink()
        if kind == 7:
            path.mkdir()
        elif kind == 8:
            os.mkfifo(path)
        elif kind == 9:
            path.symlink_to(canary)
        elif kind == 10:
            other = folder / chance.choice(names)
            path.write_bytes(other.read_bytes() if other.is_file() and not other.is_symlink() else b"")
        # 11: it is gone
    for name in ("plot-energy.svg", "plot-energy.svg.partial", ".plastron-partial-a"):
        if chance.randrange(3) == 0 and not os.path.lexists(folder / name):
            (folder / name).symlink_to(canary)


# ---- the program -------------------------------------------------------------------------------------------------------------

def environment(scratch):
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_"))}
    kept.update({"OMP_NUM_THREADS": "1", "OMPI_MCA_orte_tmpdir_base": str(scratch / "tmp"), "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1",
                 "OMPI_MCA_btl": "self", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "HOME": str(scratch / "home")})
    return kept


def run(program, arguments, folder, scratch):
    """Exit code (negative: signal, None: too long), CPU seconds, peak memory, and what was printed."""
    log = scratch / "home" / "log"
    with open(log, "wb") as output:
        def limits():
            resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS + 5))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        process = subprocess.Popen([program] + arguments, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=output, env=environment(scratch),
                                   preexec_fn=limits)
        end = time.monotonic() + WALL_SECONDS
        while True:
            done, status, usage = os.wait4(process.pid, os.WNOHANG)
            if done:
                break
            if time.monotonic() > end:
                os.kill(process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(process.pid, 0)
                status = None
                break
            time.sleep(0.01)
        process.returncode = 0
    code = None if status is None else os.waitstatus_to_exitcode(status)
    return code, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, log.read_text(errors="replace")


def snapshot(scratch, spared):
    """Path -> content, for all files of the scratch folder except in some folders."""
    found = {}
    for base, folders, files in os.walk(scratch):
        folders[:] = [f for f in folders if pathlib.Path(base, f) not in spared]
        for name in files:
            path = pathlib.Path(base, name)
            mode = path.lstat().st_mode
            found[path] = os.readlink(path) if path.is_symlink() else hashlib.sha256(path.read_bytes()).digest() if path.is_file() else mode
    return found


class Campaign:
    def __init__(self, program, source, scratch, seed):
        self.program, self.scratch, self.seed = program, scratch, seed
        shutil.rmtree(scratch, ignore_errors=True)
        for folder in ("tmp", "home", "canary"):
            (scratch / folder).mkdir(parents=True)
        self.canary = scratch / "canary" / "precious"
        self.inputs = input_cases(source)
        self.originals = {}
        for name, more in (("floor", FLOOR), ("steps", BALL + STEPS), ("accuracy", BALL)):
            text = case_text(more=more)
            if name == "accuracy":
                text = text.replace("[mesh]\nrefinements = 1\n", "[accuracy]\nenergy = 3e-2\n")
            self.originals[name] = self.original(name, text)
        self.failures, self.counts, self.largest = [], collections.Counter(), collections.Counter()

    def fail(self, words):
        self.failures.append(words)
        print(words, flush=True)

    def original(self, name, text):
        folder = self.scratch / "originals" / name
        folder.mkdir(parents=True)
        (folder / "case.toml").write_text(text)
        code, _, _, printed = run(self.program, ["run", "case.toml", "-q", "-o", "results"], folder, self.scratch)
        if code != 0:
            sys.exit("the undamaged case %s ends with %s:\n%s" % (name, code, printed))
        return folder

    def command(self, number, what, arguments, folder):
        written = {self.scratch / "tmp", self.scratch / "home", folder / "results", folder / "out"}
        before = snapshot(self.scratch, written)
        code, seconds, memory, printed = run(self.program, arguments, folder, self.scratch)
        after = snapshot(self.scratch, written)
        self.largest["CPU seconds"] = max(self.largest["CPU seconds"], seconds)
        self.largest["MB"] = max(self.largest["MB"], memory >> 20)
        self.counts[arguments[0], code] += 1
        complaints = []
        if code not in CODES:
            complaints.append("ends with %s" % ("no end" if code is None else code))
        if memory > LARGEST_RSS:
            complaints.append("takes %d MB" % (memory >> 20))
        changed = sorted({str(path) for path, _ in before.items() ^ after.items()})
        if changed:
            complaints.append("changes %s" % changed)
        for words in complaints:
            self.fail("damage %d (%s): %s %s\n%s" % (number, what, " ".join(arguments), words, printed[-600:]))
        return code

    def folder_of(self, number):
        folder = self.scratch / "trial"
        shutil.rmtree(folder, ignore_errors=True)
        self.canary.write_text("precious")
        return folder, random.Random("%d-%d" % (self.seed, number))

    def damage_results(self, number):
        folder, chance = self.folder_of(number)
        name = chance.choice(sorted(self.originals))
        shutil.copytree(self.originals[name], folder)
        damage_folder(folder / "results", self.canary, chance)
        original = self.originals[name] / "results"
        changed = [p.name for p in original.iterdir()
                   if p.name != "SHA256SUMS" and ((folder / "results" / p.name).is_symlink() or not (folder / "results" / p.name).is_file() or
                                                  (folder / "results" / p.name).read_bytes() != p.read_bytes())]
        code = self.command(number, name, ["verify", "results"], folder)
        if code == 0 and changed:
            self.fail("damage %d (%s): verify passes although %s changed" % (number, name, changed))
        self.command(number, name, ["plot", "results"], folder)
        if chance.randrange(3) == 0:
            self.command(number, name, ["run", "case.toml", "-q", "-o", "results"], folder)

    def damage_input(self, number):
        folder, chance = self.folder_of(number)
        name = chance.choice(sorted(self.inputs))
        data, text = self.inputs[name]
        folder.mkdir()
        (folder / "case.toml").write_text(text)
        (folder / name).write_bytes(damaged(data, chance))
        if self.command(number, name, ["check", "case.toml"], folder) != 2 or chance.randrange(8) == 0:
            self.command(number, name, ["run", "case.toml", "-q", "-o", "out"], folder)

    def damage(self, number):
        (self.damage_results if number % 2 else self.damage_input)(number)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    options = parser.parse_args()
    campaign = Campaign(str(pathlib.Path(options.program).resolve()), options.source.resolve(), options.scratch.resolve(), options.seed)
    for name, (data, text) in campaign.inputs.items():  # undamaged, they are good
        folder, _ = campaign.folder_of(0)
        folder.mkdir()
        (folder / "case.toml").write_text(text)
        (folder / name).write_bytes(data)
        if campaign.command(0, name, ["check", "case.toml"], folder) != 0:
            campaign.fail("the undamaged file %s is refused" % name)
        if options.count < 100:
            break
    for number in [options.only] if options.only is not None else range(1, options.count + 1):
        campaign.damage(number)
    for (command, code), count in sorted(campaign.counts.items(), key=str):
        print("%-7s exit code %-5s %5d" % (command, code, count))
    print("largest:", ", ".join("%.3g %s" % (value, unit) for unit, value in campaign.largest.items()))
    print("%d failures" % len(campaign.failures))
    sys.exit(1 if campaign.failures else 0)


main()
