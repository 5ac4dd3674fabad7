"""Runs of each model with other options than the usual ones, some at a time, so that an option whose default, unit or meaning
has changed is seen on the wire."""

import json
import subprocess

from place import environment
from stepped import recorded

AT_A_TIME = 6
ALONE = ("head_id", "pinging", "acoustics", "baud", "no_bottom", "mode")  # may silence a sonar, and what else is changed with it
STEPS, STEPS_OF_FANS = 32, 10


def other(option):
    """A value that is allowed and not the default, or None where nobody knows one."""
    default = option["default"]
    if option["type"] == "boolean":
        return not default
    if "choices" in option:
        return next((c for c in reversed(option["choices"]) if c != default), None)
    if option["type"] == "text":
        return None
    low, high = option.get("minimum", default), option.get("maximum", default + 1)
    value = min(max(default * 1.2, low), high) if default else min(high, low + (high - low) / 8)
    if option["type"] == "integer":
        value = min(high, default + 1) if default < high else default - 1
    value = value if value != default else (low + default) / 2
    return round(value, 6) if value != round(value) else int(value)


def listed(program, model, folder):
    done = subprocess.run([program, "list", model, "--json"], cwd=folder.path, env=environment(), capture_output=True)
    return json.loads(done.stdout)["models"][0]["options"]


def variants(options):
    """Lines of options for some runs."""
    values = [(o["name"], other(o)) for o in options]
    values = [(name, value) for name, value in values if value is not None]
    packs = [[v] for v in values if v[0] in ALONE]
    values = [v for v in values if v[0] not in ALONE]
    packs += [values[at : at + AT_A_TIME] for at in range(0, len(values), AT_A_TIME)]
    for pack in packs:
        yield ", ".join(f"{name}: {json.dumps(value)}" for name, value in pack)


def optioned(run):
    """The wires of a model's run, once for every few options."""
    device = run.devices[0]
    steps = STEPS if "line" in device.ports else STEPS_OF_FANS

    def record(program, folder):
        files = {}
        for n, line in enumerate(variants(listed(program, device.model, folder))):
            short = run._replace(devices=[device._replace(options=line, words=device.words[:steps])], steps=steps)
            made = recorded(program, short, folder, is_brief=True)
            files |= {f"{n}.{name}": data for name, data in made.items()}
        return files

    return record
