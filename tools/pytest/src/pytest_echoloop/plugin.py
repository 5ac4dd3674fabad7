"""The fixture `echoloop`, and what a failed test's report gets from it."""

import re
import shutil
from pathlib import Path

import pytest

from . import program, tank
from .program import EcholoopError
from .sonar import Run, Sonar

_RUNS = pytest.StashKey()
_SHOWN = 12  # messages in a report

_SCENARIO = """scene: tank.gltf
water: {{temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{pose: {{position: {position}, rpy_deg: {rpy_deg}}}{input}}}
devices:
  - {{name: {name}, model: {model}, endpoints: {endpoints}, options: {options}, mount: {{rpy_deg: {mount}}}}}
"""


def pytest_addoption(parser):
    parser.getgroup("echoloop").addoption(
        "--echoloop-captures", metavar="FOLDER",
        help="copy the capture of the wire of each failed test to this folder, e.g. for a CI to keep")


@pytest.fixture
def echoloop(request, tmp_path):
    """Starts sonars: echoloop("ping360") or echoloop(scenario="my.yaml"). They end with the test."""
    runs = request.node.stash.setdefault(_RUNS, [])

    def start(model=None, *, scenario=None, stepped=False, settings=(), **options):
        __tracebackhide__ = True
        try:
            if (model is None) == (scenario is None):
                raise EcholoopError('give a model, as in echoloop("ping360"), or scenario="my.yaml"')
            if scenario is not None and options:
                raise EcholoopError(f"{', '.join(options)}: only for a model; a scenario says it itself, or "
                                    'settings=["devices.sonar.options.gain=50"] changes it')
            folder = tmp_path / f"echoloop-{len(runs) + 1}"
            folder.mkdir()
            file = _file_of(folder, scenario) if scenario else _model_file(folder, model, stepped, **options)
            run = Run(folder, file, settings, stepped)
        except EcholoopError as error:
            pytest.fail(f"echoloop: {error}", pytrace=False)
        runs.append(run)
        return Sonar(run, next(iter(run.devices)))

    yield start
    problems = []
    for run in runs:
        try:
            run.close()
        except EcholoopError as error:
            problems.append(str(error))
    if problems:
        pytest.fail("echoloop: " + "\n".join(problems), pytrace=False)


def _file_of(folder, scenario):
    """A path stays where it is, since its scene is named from there; a text has several lines."""
    if isinstance(scenario, str) and "\n" in scenario:
        (folder / "scenario.yaml").write_text(scenario)
        return folder / "scenario.yaml"
    return Path(scenario)


def _model_file(folder, model, stepped, *, endpoints=None, options=None, size=(12, 8, 4), position=(0, 0, -2),
                rpy_deg=(0, 0, 0), mount=(0, 0, 0)):
    """A scenario of one sonar in the middle of a tank: `size` is its length, width and depth in m."""
    if endpoints is None:
        (found,) = (m for m in program.ask("list", model)["models"])
        endpoints = found["default_endpoints"]
        for end in endpoints:
            if end.startswith("udp://"):
                raise EcholoopError(f"{model} sends to its driver: bind a UDP port, and give endpoints={endpoints} "
                                    "with its number")
    (folder / "tank.gltf").write_text(tank.gltf(*size))
    text = _SCENARIO.format(name=model, model=model, endpoints=list(endpoints), position=list(position),
                            rpy_deg=list(rpy_deg), mount=list(mount),
                            options=_yaml(options or {}), input="" if stepped else ', input: "tcp-listen://127.0.0.1:0"')
    (folder / "scenario.yaml").write_text(text)
    return folder / "scenario.yaml"


def _yaml(options):
    words = {True: "true", False: "false"}
    return "{" + ", ".join(f"{k}: {words.get(v, v) if isinstance(v, bool) else repr(v)}" for k, v in options.items()) + "}"


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    report = (yield).get_result()
    if not report.failed or report.when == "teardown":
        return
    for run in item.stash.get(_RUNS, []):
        try:
            run.close()  # so that the capture is whole
        except EcholoopError as error:
            report.sections.append(("echoloop", str(error)))
        _attach(report, run, item)


def _attach(report, run, item):
    text = [f"capture of the wire: {run.capture}"]
    if folder := item.config.getoption("--echoloop-captures"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        kept = Path(folder) / (re.sub(r"[^\w.-]+", "-", item.nodeid).strip("-") + f"-{run.folder.name}.pcapng")
        shutil.copyfile(run.capture, kept)
        text.append(f"a copy of it: {kept}")
    for name in run.devices:
        try:
            messages = Sonar(run, name).messages(count=0)
        except EcholoopError as error:
            text.append(f"{name}: its messages cannot be shown: {error}")
            continue
        text.append(f"{name}: {len(messages)} messages" + (", the last:" if messages else ""))
        text += [str(message) for message in messages[-_SHOWN:]]
    if said := run.process.said():
        text.append(f"the program said:\n{said}")
    report.sections.append(("echoloop", "\n".join(text)))
