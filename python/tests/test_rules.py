"""A team's own rules, in check and in Judge."""

import json
import os
import pickle
import subprocess

import adsdv
import pytest
from test_judge import frames

RULES = """# ours
calm: never AS_STATE is AS_READY "it stays off"
pace: always VEH_SPEED_ACTUAL <= 6 m/s
end: after AS_STATE is EMERGENCY_BRAKE, ASMS off within 5 s
"""


def test_what_breaks_a_rule_is_a_violation_and_each_is_reported(mission):
    report = adsdv.check(mission, rules=RULES)
    assert report.verdict == "violates"
    [finding] = report.violations
    assert (finding["party"], finding["section"], finding["rule"]) == ("OWN", "line 2", "custom-rule")
    verdicts = [(rule["line"], rule["name"], rule["verdict"], rule["broken"]) for rule in report.rules]
    assert verdicts == [(2, "calm", "broken", 1), (3, "pace", "holds", 0), (4, "end", "never decided", 0)]
    calm, _, end = report.rules
    assert (calm["note"], calm["breaches"][0]["t"]) == ("it stays off", finding["t"])
    assert end["why"] == "what it waits for never came"
    assert adsdv.Report(report.to_dict()) == report == pickle.loads(pickle.dumps(report))


def test_without_rules_there_is_nothing_of_them(mission):
    report = adsdv.check(mission)
    assert (report.rules, "rules" in report.to_dict()) == ([], False)


def test_reports_are_those_of_the_command(command, any_log, tmp_path):
    file = tmp_path / "team.rules"
    file.write_text(RULES)
    environment = {key: value for key, value in os.environ.items() if key != "ADSDV_EDITION"}
    judge = [command, "check", "--json", "--rules", file, any_log]
    run = subprocess.run(judge, capture_output=True, check=False, env=environment)
    printed = json.loads(run.stdout)
    report = adsdv.check(any_log, rules=file.read_text())
    assert report.rules == printed["rules"]
    assert adsdv.Report(printed) == report


def test_a_live_judge_follows_them_as_well(any_log):
    judge = adsdv.Judge(rules=RULES, edition="4.0")
    told = []
    for frame in frames(any_log.read_text().splitlines()):
        judge.frame(*frame)
        told += judge.news()[1]
    report = judge.finish()
    told += report.findings
    assert report.rules == adsdv.check(any_log, rules=RULES, edition="4.0").rules
    assert [one["section"] for one in told if one["party"] == "OWN"] == ["line 2"]


def judged(**options):
    return adsdv.check(["(1.0) can0 520#0000010000000000"], **options)


@pytest.mark.parametrize("judge", [judged, adsdv.Judge])
def test_what_is_wrong_is_said_with_its_place(judge):
    with pytest.raises(adsdv.RulesError, match=r'^rules, line 2, column 13: found "sped"') as wrong:
        judge(rules="# ours\nsafe: never sped > 5", edition="3.0")
    assert (wrong.value.line, wrong.value.column) == (2, 13)
    with pytest.raises(adsdv.RulesError, match=r"\nline 2, column 4: found ") as wrong:
        judge(rules="safe: never sped > 5\nb: > 3\n" + "".join(f"c{n}: sped on until moving\n" for n in range(19)))
    places = [(one["line"], one["column"], one["width"]) for one in wrong.value.mistakes]
    assert places[:2] == [(1, 13, 4), (2, 4, 1)]
    assert (len(places), wrong.value.more) == (20, 1)
    assert wrong.value.mistakes[1]["why"].startswith('found ">"; expected')
    newer = "stage: never EBS_STATE is EBS_FAULT"
    with pytest.raises(adsdv.RulesError, match="edition 3.0 has no such signal") as wrong:
        judge(rules=newer, edition="3.0")
    assert (wrong.value.line, wrong.value.column) == (1, 14)
    judge(rules=newer, edition="2026")
    with pytest.raises(adsdv.InputError, match='"rules" is 5; expected the text of a file of rules'):
        judge(rules=5)
    with pytest.raises(adsdv.RulesError):
        judge(rules="")


def test_rules_of_another_edition_than_the_log_speaks_are_wrong(mission):
    with pytest.raises(adsdv.RulesError, match="line 1, column 14"):
        adsdv.check(mission, rules="stage: never EBS_STATE is EBS_FAULT", edition=None)
