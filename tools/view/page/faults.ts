// Faults on command: a button for each kind, where the run lets the page ask.
import type { Answer, Hello } from "./news";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

export class Faults {
  constructor(private readonly ask: (line: object) => void) {
    element("fault-clear").onclick = () => this.ask({ clear: "all" });
  }

  private tellActive(faults: NonNullable<Answer["faults"]>): void {
    const on = faults.filter((fault) => fault.on).map(({ device, kind, made }) => `${kind.replace(/_/g, " ")} at ${device}, made ${made} times`);
    element("fault-active").textContent = on.length === 0 ? "none is on" : "on: " + on.join("; ");
  }

  offer({ control, devices, faults }: Hello): void {
    element("fault-panel").hidden = !control;
    element<HTMLSelectElement>("fault-device").replaceChildren(...devices.map(({ name }) => new Option(name, name)));
    element("fault-kinds").replaceChildren(
      ...faults.map(({ name, help, momentary, parameters }) => {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = name.replace(/_/g, " ");
        button.title = help;
        button.dataset.fault = name;
        button.onclick = () =>
          this.ask({
            fault: {
              device: element<HTMLSelectElement>("fault-device").value,
              kind: name,
              ...parameters,
              ...(momentary ? {} : { for: Number(element<HTMLInputElement>("fault-seconds").value) }),
            },
          });
        return button;
      }),
    );
  }

  answer(answer: Answer): void {
    if (answer.faults !== undefined) return this.tellActive(answer.faults);
    const told = element("fault-answer");
    told.classList.toggle("bad", !answer.ok);
    told.textContent = answer.ok ? (answer.cleared === undefined ? `fault ${answer.id} is on` : `${answer.cleared} ended`) : answer.error ?? "";
  }
}
