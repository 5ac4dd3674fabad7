"""What is drawn without a wire: renderings of each model, and the numbers of `echoloop validate`."""

from stepped import Run
from texts import Shell


def pictures(run: Run):
    def record(program, folder):
        (folder.path / "run.yaml").write_text(run.scenario().replace("{folder}", str(folder.path)))
        shell = Shell(program, folder)
        shell.run("render", "run.yaml", "--out", "picture.npy", "--json")
        shell.run("render", "run.yaml", "--out", "near.csv", "--range", "5")
        shell.run("render", "run.yaml", "--out", "step.npy", "--step", "1", "--rule", "cerqueira2016")
        shell.run("check", "run.yaml", "--json")
        files = {name: folder.path / name for name in ("picture.npy", "near.csv", "step.npy")}
        return {"said.txt": folder.masked(shell.text), **{n: f.read_bytes() for n, f in files.items() if f.exists()}}

    return record


def report(program, folder):
    shell = Shell(program, folder)
    shell.run("validate", "--json")
    return {"said.txt": folder.masked(shell.text)}
