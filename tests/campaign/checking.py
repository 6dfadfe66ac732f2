"""A case with its oracles: runs it, runs the second cases, and returns what is wrong."""

import copy
import dataclasses
import shutil

from balances import Checks
from cases import Case
from features import forbidding
from frame import norm, plus
from judging import compare
from oracles import BY_NAME


@dataclasses.dataclass
class Finding:
    """kind: crash, hang, refused, unsolved, balance, verify, status, differs. `oracle`: its name, or "" for the case by itself."""

    kind: str
    oracle: str
    words: str


SILENT = {"crash", "hang", "balance", "verify", "status", "differs"}


def of_run(outcome, oracle=""):
    """What a single run has wrong."""
    if outcome.code == "hang":
        return [Finding("hang", oracle, "no end within the time limit")]
    if outcome.code not in (0, 2, 3) or (outcome.code == 0 and outcome.results is None) or "internal error" in outcome.text:
        return [Finding("crash", oracle, f"exit code {outcome.code}: {outcome.text[-300:]}")]
    if outcome.code == 2:
        words = " ".join(outcome.text.split())
        return [Finding("refused", oracle, words[max(words.find("error:"), 0):][:300])]
    if outcome.code == 3:
        return [Finding("unsolved", oracle, f"{outcome.word}: {' '.join((outcome.results or {}).get('status_text', '').split())[:240]}")]
    return []


class Checker:
    def __init__(self, program, folder, seed):
        self.program, self.folder, self.seed, self.count = program, folder, seed, 0

    def _run(self, case, by="program"):
        self.count += 1
        return self.program.run(case, self.folder / f"{self.count}", by)

    def check(self, number, row, oracles):
        """Findings of a case, and the names of the oracles that were compared."""
        case = Case(self.seed, number, row)
        base = self._run(case)
        found = of_run(base)
        used = []
        if base.is_solved:
            found += [Finding("balance", "", words) for words in Checks(base).all()]
        if not base.is_solved:
            return found, used, base
        for name in oracles:
            more, compared = self._oracle(BY_NAME[name], base)
            found += more
            used += [name] * compared
        return found, used, base

    def _verify(self, base):
        code, text = self.program.call([self.program.path, "verify", "out"], base.folder)
        return [] if code == 0 else [Finding("verify", "", f"exit code {code}: {text[-400:]}")]

    def _oracle(self, oracle, base):
        if oracle.name == "verify":
            return self._verify(base), True
        variant = oracle.variants(base.case)
        if variant is None:
            return [], False
        row, extra = variant
        if oracle.kind == "limit":
            base = self._run(Case(self.seed, base.case.number, row | {"model": "finite"}))
        if extra.get("by") == "python" and self.program.python is None:
            return [], False
        case = Case(self.seed, base.case.number, row, **changes(base, extra))
        if "fixed" in extra:
            moved = base.case.frame.back(base.results["obstacles"][0]["translation"], length=1)
            case.bodies[0][1].origin = plus(case.bodies[0][1].origin, moved)
        second = self._run(case, extra.get("by", "program"))
        found = of_run(second, oracle.name)
        if oracle.kind == "limit" and not base.is_solved:
            found += of_run(base, oracle.name)
        if found and oracle.kind in ("same", "iterated") and found[0].kind in ("unsolved", "refused"):
            found = [Finding("status", oracle.name, found[0].words)]
        if not base.is_solved or not second.is_solved:
            return found, True
        differences, self.largest = compare(base, second, oracle.kind)
        return [Finding("differs", oracle.name, "; ".join(differences))] if differences else [], True


def changes(base, extra):
    """The `extra` of a Case for what an oracle says."""
    row = base.case.row
    result = {k: extra[k] for k in ("supports", "accuracy") if k in extra}
    if "curves" in base.case.extra and extra.get("source", "facets") == "facets":
        result["curves"] = base.case.extra["curves"]
    for key, name in (("face", "face"), ("steps", "steps")):
        if name in extra:
            result[key] = extra[name]
    if "finer" in extra or "refinements" in extra:
        result["refinements"] = (1 if row["degree"] <= 2 else 0) + 1
    if "raised" in extra:
        result["degree"] = extra["raised"]
    if "layers" in extra:
        result["material"] = "isotropic layers"
    if "shape" in extra:
        result["other_shape"] = True
    if "fixed" in extra:
        result["fixed_at"] = True
    if "factor" in extra:
        result["factor"] = base.results["history"][-1]["load_factor"]
    return result
