// The scene in 3D: its triangles, where each sonar is and was, and the beams of its last ping. Drawn only when
// something has changed. East is to the right, north away from the viewer, up is up.
import type { Ping, SceneNews } from "./news";
import { beamsOf, footprintsOf, matrixOf, rotated, type Matrix, type Vector } from "./beams";
import { farthest } from "./sketch";

const vertexText = `#version 300 es
in vec3 place; uniform mat4 view, model; out vec3 world;
void main() { vec4 w = model * vec4(place, 1.0); world = w.xyz; gl_Position = view * w; gl_PointSize = 7.0; }`;
const fragmentText = `#version 300 es
precision highp float; in vec3 world; uniform vec4 colour; uniform bool shaded; out vec4 dot_colour;
void main() {
  float light = 1.0;
  if (shaded) { vec3 n = normalize(cross(dFdx(world), dFdy(world))); light = 0.35 + 0.65 * abs(dot(n, normalize(vec3(0.3, 0.5, 0.8)))); }
  dot_colour = vec4(colour.rgb * light, colour.a);
}`;
const trailLength = 2000;
const colours: Vector[] = [[0.98, 0.62, 0.2], [0.35, 0.75, 0.95], [0.55, 0.85, 0.4], [0.95, 0.45, 0.6], [0.75, 0.6, 0.95], [0.95, 0.9, 0.4]];

export class SceneView {
  private readonly gl: WebGL2RenderingContext | null;
  private program: WebGLProgram | null = null;
  private places: Record<string, WebGLUniformLocation | null> = {};
  private triangles: { mover: number; first: number; corners: number }[] = [];
  private solid: WebGLBuffer | null = null;
  private lines: WebGLBuffer | null = null;
  private pings = new Map<string, Ping>();
  private trails = new Map<string, number[]>();
  private centre: Vector = [0, 0, 0];
  private distance = 20;
  private turn = -0.6; // rad, of the viewer about the vertical
  private rise = 0.6; // rad, of the viewer over the horizon
  private changed = true;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly camera: HTMLSelectElement) {
    this.gl = canvas.getContext("webgl2", { antialias: true });
    camera.onchange = () => (this.changed = true);
    canvas.onpointerdown = (event) => canvas.setPointerCapture(event.pointerId);
    canvas.onpointermove = (event) => {
      if (event.buttons === 0) return;
      this.turn -= event.movementX / 150;
      this.rise = Math.max(-1.5, Math.min(1.5, this.rise + event.movementY / 150));
      this.changed = true;
    };
    canvas.onwheel = (event) => {
      event.preventDefault();
      this.distance *= Math.exp(event.deltaY / 800);
      this.changed = true;
    };
    if (this.gl) this.build(this.gl);
  }

  load(scene: SceneNews, corners: Float32Array): void {
    const [low, high] = scene.bounds;
    if (this.pings.size === 0) {
      this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
      this.distance = 1.2 * Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    }
    let first = 0;
    this.triangles = scene.parts.map(({ mover, corners: count }) => {
      const part = { mover, first, corners: count };
      first += count;
      return part;
    });
    const gl = this.gl;
    if (gl === null) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.solid);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    this.changed = true;
  }

  /** Forgets all pings; the triangles stay. */
  reset(): void {
    this.pings.clear();
    this.trails.clear();
    this.changed = true;
  }

  take(ping: Ping): void {
    this.pings.set(ping.device, ping);
    const trail = this.trails.get(ping.device) ?? [];
    const last = trail.slice(-3);
    const [x, y, z] = ping.sonar;
    if (this.pings.size === 1 && trail.length === 0) {
      this.centre = [x, y, z]; // where something happens
      this.distance = 2 * farthest(ping);
    }
    if (last.length === 0 || Math.hypot(x - last[0], y - last[1], z - last[2]) > 0.02) trail.push(x, y, z);
    if (trail.length > 3 * trailLength) trail.splice(0, 3);
    this.trails.set(ping.device, trail);
    this.changed = true;
  }

  /** `always`: so that its dots can be read before they are shown. */
  draw(always = false): void {
    const gl = this.gl;
    if (gl === null || !(this.changed || always) || this.program === null) return;
    this.changed = false;
    const dots = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * dots));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * dots));
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0.05, 0.1, 0.14, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.places.view, false, this.view());
    gl.bindBuffer(gl.ARRAY_BUFFER, this.solid);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.uniform1i(this.places.shaded, 1);
    gl.uniform4f(this.places.colour, 0.55, 0.6, 0.6, 1);
    const movers = [...this.pings.values()].reduce<Ping | null>((a, b) => (a === null || b.t > a.t ? b : a), null)?.movers ?? [];
    for (const part of this.triangles) {
      const pose = part.mover > 0 ? movers[part.mover - 1] : undefined;
      gl.uniformMatrix4fv(this.places.model, false, pose ? matrixOf(pose) : matrixOf([0, 0, 0, 1, 0, 0, 0]));
      gl.drawArrays(gl.TRIANGLES, part.first, part.corners);
    }
    gl.uniform1i(this.places.shaded, 0);
    gl.uniformMatrix4fv(this.places.model, false, matrixOf([0, 0, 0, 1, 0, 0, 0]));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lines);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    let index = 0;
    for (const [device, ping] of this.pings) {
      const [r, g, b] = colours[index++ % colours.length];
      gl.uniform4f(this.places.colour, r, g, b, 1);
      this.stroke(gl, gl.LINE_STRIP, this.trails.get(device) ?? []);
      this.stroke(gl, gl.POINTS, ping.sonar.slice(0, 3));
      gl.uniform4f(this.places.colour, r * 0.6, g * 0.6, b * 0.6, 1);
      this.stroke(gl, gl.LINES, beamsOf(ping));
      gl.uniform4f(this.places.colour, r, g, b, 1);
      this.stroke(gl, gl.LINES, footprintsOf(ping));
    }
  }

  private stroke(gl: WebGL2RenderingContext, how: number, places: number[]): void {
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STREAM_DRAW);
    gl.drawArrays(how, 0, places.length / 3);
  }

  private view(): Matrix {
    const aspect = this.canvas.width / this.canvas.height;
    let at = this.centre;
    let { turn, rise, distance } = this;
    const first = this.pings.values().next().value as Ping | undefined;
    if (this.camera.value === "top") [turn, rise] = [0, 1.5707];
    if (this.camera.value === "follow" && first !== undefined) {
      at = [first.sonar[0], first.sonar[1], first.sonar[2]];
      const ahead = rotated(first.sonar, [1, 0, 0]);
      turn = Math.atan2(-ahead[0], ahead[1]) + this.turn + 0.6;
      distance = Math.min(distance, 12);
    }
    const back: Vector = [Math.sin(turn) * Math.cos(rise), -Math.cos(turn) * Math.cos(rise), Math.sin(rise)];
    const right: Vector = [Math.cos(turn), Math.sin(turn), 0];
    const up: Vector = [
      back[1] * right[2] - back[2] * right[1],
      back[2] * right[0] - back[0] * right[2],
      back[0] * right[1] - back[1] * right[0],
    ];
    const eye: Vector = [at[0] + back[0] * distance, at[1] + back[1] * distance, at[2] + back[2] * distance];
    const near = distance / 100;
    const far = distance * 10;
    const f = 1.7;
    const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const rows = [
      [...right.map((v) => (v * f) / aspect), (-dot(right, eye) * f) / aspect],
      [...up.map((v) => v * f), -dot(up, eye) * f],
      [...back.map((v) => -v), dot(back, eye)],
    ];
    const k = (far + near) / (far - near);
    const deep = [...rows[2].map((v) => v * k)];
    deep[3] -= (2 * far * near) / (far - near);
    const all = [rows[0], rows[1], deep, rows[2]];
    return new Float32Array([0, 1, 2, 3].flatMap((column) => all.map((row) => row[column])));
  }

  private build(gl: WebGL2RenderingContext): void {
    const program = gl.createProgram()!;
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]] as [number, string][]) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "place");
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return;
    gl.enableVertexAttribArray(0);
    for (const name of ["view", "model", "colour", "shaded"]) this.places[name] = gl.getUniformLocation(program, name);
    this.solid = gl.createBuffer();
    this.lines = gl.createBuffer();
    this.program = program;
  }
}
