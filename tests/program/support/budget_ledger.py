# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A ledger whose combinations are made up, for tests of time budgets."""
import json


def make_ledger(case, folder, settings):
    """Measures builtin:plain and puts these combinations into FOLDER/ledger.json: (settings, ms, error) each."""
    case.expect(0, "cost", "builtin:plain", "--quick", "--size", "64x36", "--knobs", "views.scale", "--points", "2", "--out", folder)
    ledger = case.read_json(f"{folder}/ledger.json")
    point = ledger["points"][0]
    ledger["points"] = [point | {"settings": values, "ms": {"median": ms, "p10": ms, "p90": ms},
                                 "error": point["error"] | {"flip": {"mean": error, "p99": error}}}
                        for values, ms, error in settings]
    (case.folder / folder / "ledger.json").write_text(json.dumps(ledger), encoding="utf-8")
