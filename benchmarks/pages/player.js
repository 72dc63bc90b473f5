"use strict";

/** The controls of the page, and what they show: one run, or two from the same time on. */
class Player {
  constructor(recording) {
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 10);
    this.box = document.getElementById("views");
    this.recordings = [recording];
    this.views = [];
    this.now = 0;  // the number of the picture of the first run
    this.drawn = 0;  // so far
    this.element = id => document.getElementById(id);
    this.controls = new THREE.OrbitControls(this.camera, this.box);
    this.controls.enableKeys = false;  // the keys are those of time
    this.box.tabIndex = -1;
    this.camera.userData.target = () => this.controls.target;
    this.controls.addEventListener("change", () => this.draw());
    this.lists();
    this.wire();
    try {
      this.views.push(new BodyView(this.box, recording, this.camera));
    } catch (error) {
      d3.select(this.box).text(`${error.message}.`);
    }
    this.first_view();
    this.begin();
    const {run} = recording, step = Math.max(...run.size) / 65535 / 2;
    this.element("precision").textContent = `${run.frames.length} of ${run.taken} pictures` +
        (run.frames.length < run.taken ? ", so that this file stays small" : "") +
        `. Places are exact to ${BodyView.in_words(step)} m, colours to a 254th of the largest value; curves have the numbers of the run.`;
  }

  lists() {
    const {run} = this.recordings[0], used = name => new Set(run.shapes.flatMap((shape, k) => [...new Set(this.recordings[0].shape(k)[name])])).size > 1;
    const names = ["component", ...(used("material") ? ["material"] : []), ...(used("body") ? ["body"] : []), ...run.quantities.map(one => one.name)];
    d3.select("#colour").selectAll("option").data(names).enter().append("option").text(name => name);
    // as films: as fast as the motion, but 4 seconds at least and 12 at most
    const lasts = run.frames[run.frames.length - 1].time - run.frames[0].time;
    this.natural = lasts > 0 ? lasts / Math.min(12, Math.max(4, lasts)) : 1;
    const speeds = [0.1, 0.25, 0.5, 1, 2, 4].map(k => k * this.natural);
    d3.select("#speed").selectAll("option").data(speeds).enter().append("option").attr("value", speed => speed)
      .text(speed => `${BodyView.in_words(speed)} × real time`);
    this.element("speed").value = this.natural;
    this.element("obstacles").parentNode.hidden = run.obstacles.length === 0;
  }

  wire() {
    const on = (id, event, act) => this.element(id).addEventListener(event, act);
    on("play", "click", () => this.play(!this.playing));
    on("time", "input", () => this.go_to(Number(this.element("time").value)));
    for (const id of ["colour", "edges", "marks", "obstacles"]) on(id, "change", () => this.show());
    on("reset", "click", () => this.first_view());
    on("beside", "change", () => this.element("beside").files[0] && this.put_beside(this.element("beside").files[0]));
    window.addEventListener("beforeprint", () => this.views.forEach(view => view.printed.attr("src", view.picture())));
    document.addEventListener("keydown", event => {
      // the keys of a control that has the focus are its own; the slider's are these
      const control = event.target.closest("button, select, summary, input:not([type=range])");
      if (control || event.ctrlKey || event.altKey || event.metaKey) return;
      const go = {ArrowLeft: this.now - 1, ArrowRight: this.now + 1, Home: 0, End: this.times.length - 1}[event.key];
      if (event.key === " ") this.play(!this.playing);
      else if (go !== undefined) this.go_to(go);
      else return;
      event.preventDefault();
    });
    // a click, and not the end of a turn
    this.box.addEventListener("pointerdown", event => this.pressed = [event.clientX, event.clientY], true);
    this.box.addEventListener("click", event => {
      if (this.pressed && Math.hypot(event.clientX - this.pressed[0], event.clientY - this.pressed[1]) > 4) return;
      const view = this.views.find(one => one.canvas === event.target);
      if (view) this.pick(view, event.clientX, event.clientY);
    });
  }

  begin() {
    this.times = this.recordings[0].times;
    this.element("time").max = this.times.length - 1;
    d3.select("#curves").selectAll("*").remove();
    this.diagrams = this.recordings[0].run.curves.map(data => new Diagram("#curves", this.recordings
      .map((one, r) => ({name: this.recordings.length > 1 ? this.view_name(r) : "", data: one.run.curves.find(other => other.title === data.title)}))
      .filter(one => one.data), time => this.go_to_time(time)));
    this.choose_none();
    this.show();
  }

  /** How curves call a run: by its name, or by where it is if both have one name. */
  view_name(r) {
    const [a, b] = this.recordings.map(one => one.title);
    return a === b ? ["left", "right"][r] : this.recordings[r].title;
  }

  first_view() {
    const {page} = this.recordings[0], {box, middle, radius} = BodyView.reach(this.recordings);
    this.camera.up.set(...page.up);
    this.camera.position.copy(middle).addScaledVector(new THREE.Vector3(...page.towards), 10 * radius);
    [this.camera.near, this.camera.far, this.camera.zoom] = [0.01 * radius, 30 * radius, 1];
    this.controls.target.copy(middle);
    this.controls.update();
    this.camera.updateMatrixWorld();
    this.camera.userData.half = [0, 1].map(axis => {
      const along = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, axis);
      const size = box.getSize(new THREE.Vector3()).toArray();
      return Math.max(1e-3 * radius, 0.56 * size.reduce((sum, x, a) => sum + x * Math.abs(along.getComponent(a)), 0));
    });
    this.draw();
  }

  go_to(number) {
    this.now = Math.max(0, Math.min(this.times.length - 1, number));
    this.show();
  }

  go_to_time(time) {
    this.go_to(this.recordings[0].frame_at(time));
  }

  play(playing) {
    this.playing = playing;
    this.element("play").textContent = playing ? "Pause" : "Play";
    if (!playing) return this.show();
    if (this.now === this.times.length - 1) this.go_to(0);
    let last = null, time = this.times[this.now];
    const tick = stamp => {
      if (!this.playing) return;
      if (last !== null) time += (stamp - last) / 1000 * Number(this.element("speed").value);
      last = stamp;
      const end = this.times[this.times.length - 1];
      if (time >= end) time = this.times[0];
      const number = this.recordings[0].frame_at(time);
      if (number !== this.now) this.go_to(number);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  look() {
    const by = this.element("colour").value;
    // one scale for both
    const largest = Math.max(0, ...this.recordings.map(one => (one.quantity(by) || {largest: 0}).largest));
    const is_on = id => this.element(id).checked;
    return {by, largest, edges: is_on("edges"), marks: is_on("marks"), obstacles: is_on("obstacles")};
  }

  show() {
    const time = this.times[this.now], look = this.look();
    for (const view of this.views) view.show(view.recording.frame_at(time), look);
    this.element("time").value = this.now;
    const said = `t = ${Number(time.toPrecision(5))} s`;
    this.element("time").setAttribute("aria-valuetext", said);
    this.element("now").textContent = `${said}, ${this.now + 1} of ${this.times.length}`;
    // text and curves take longer to paint than bodies: while the pictures play, four times in a second is enough
    const stamp = performance.now();
    if (!this.playing || !(stamp - this.told < 250)) {
      this.told = stamp;
      for (const diagram of [...this.diagrams, ...this.ways]) diagram.show(time);
    }
    ++this.drawn;
  }

  draw() {
    for (const view of this.views) if (view.shown >= 0) view.draw();
  }

  choose_none() {
    d3.select("#picked").selectAll("*").remove();
    this.ways = [];
    for (const view of this.views) view.way = null;
  }

  pick(view, x, y) {
    const point = view.point_at(x, y);
    this.choose_none();
    if (point !== null) {
      const {number, way} = view.recording.way_of(view.shown, point);
      view.way = {way};
      const at = way[view.shown].at, name = number < 0 ? "A vertex that refinement made" : `Vertex ${number} of the mesh`;
      this.element("said").textContent = `${name}, at (${at.map(c => BodyView.in_words(c)).join(", ")}) m` +
          (this.views.length > 1 ? ` in ${this.view_name(this.views.indexOf(view))}` : "") + ".";
      const first = way.find(one => one);
      const curves = [0, 1, 2].map(axis => ({name: "xyz"[axis], values: way.map(one => one && one.at[axis] - first.at[axis])}));
      this.ways = [new Diagram("#picked", [{name: "", data: {title: "Displacement of the chosen vertex", unit: "m",
        note: "From the first picture that shows it.", times: view.recording.times, curves}}], time => this.go_to_time(time))];
    } else {
      this.element("said").textContent = "";
    }
    this.show();
  }

  async put_beside(file) {
    try {
      const recording = Recording.of(await file.text());
      if (this.recordings.length > 1) {
        const old = this.views.pop();
        old.renderer.dispose();
        old.figure.remove();
        this.recordings.pop();
      }
      if (this.views.length) this.views.push(new BodyView(this.box, recording, this.camera));
      this.recordings.push(recording);
      this.element("said").textContent = `Beside it: ${recording.title}, at the same times and in the same scale of colours.`;
      this.first_view();
      this.begin();
    } catch (error) {
      this.element("said").textContent = `${file.name}: ${error.message}.`;
    }
  }
}

window.player = new Player(new Recording(JSON.parse(document.getElementById("page").textContent)));
