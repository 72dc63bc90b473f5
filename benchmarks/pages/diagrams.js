"use strict";

/** Curves over time, with a line at the time that is shown, their values there, and a button that saves them as SVG. */
class Diagram {
  static get colours() {
    return ["#4e79a7", "#f28e2b", "#59a14f", "#b07aa1", "#76b7b2", "#e15759", "#9c755f", "#bab0ac"];
  }

  /**
   * Runs have a diagram (run_diagrams.h) each: a second one is dashed, and of parts that are stacked it is their sum. `go_to` takes a time that is pointed at.
   */
  constructor(parent, runs, go_to) {
    const data = runs[0].data, is_stacked = data.curves.some(one => one.is_part), unit = data.unit ? ` [${data.unit}]` : "";
    this.figure = d3.select(parent).append("figure");
    const heading = this.figure.append("div").attr("class", "heading");
    heading.append("span").text(data.title + unit);
    heading.append("button").attr("type", "button").attr("aria-label", `Save ${data.title} as SVG`).text("SVG").on("click", () => save_svg(this.svg.node(), data.title));
    const width = 520, height = 230, left = 62, right = 16, top = 8, bottom = 34;
    this.svg = this.figure.append("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("xmlns", "http://www.w3.org/2000/svg").attr("role", "img");
    this.svg.append("title").text(`${data.title}${unit} over time [s]`);
    this.keys = this.figure.append("div").attr("class", "keys");
    if (data.note) this.figure.append("figcaption").text(data.note);

    this.lines = runs.flatMap((run, r) => Diagram.lines_of(run, r));
    const finite = this.lines.flatMap(line => line.values.concat(line.base || [])).filter(x => x !== null);
    const [low, high] = is_stacked ? [Math.min(0, ...finite), Math.max(0, ...finite)] : d3.extent(finite.length ? finite : [0]);
    const room = high > low ? 0.04 * (high - low) : Math.abs(high) / 2 || 1;
    this.x = d3.scaleLinear().domain(d3.extent(runs.flatMap(run => run.data.times))).range([left, width - right]);
    this.y = d3.scaleLinear().domain([is_stacked && low === 0 ? 0 : low - room, high + room]).range([height - bottom, top]);
    const axis = (name, scale, place) => {
      const group = this.svg.append("g").attr("transform", place).call(scale);
      group.attr("font-size", 12).attr("font-family", "sans-serif").attr("class", name);
    };
    axis("x", d3.axisBottom(this.x).ticks(6), `translate(0,${height - bottom})`);
    axis("y", d3.axisLeft(this.y).ticks(5, Math.max(Math.abs(low), Math.abs(high)) < 1e-2 || high >= 1e5 ? ".1e" : undefined), `translate(${left},0)`);
    this.svg.append("text").attr("x", width - right).attr("y", height - 4).attr("text-anchor", "end").attr("font-size", 12)
      .attr("font-family", "sans-serif").attr("fill", "currentColor").text("time [s]");

    for (const line of this.lines) {
      const points = line.times.map((time, k) => [time, line.values[k], line.base ? line.base[k] : 0]);
      const shape = line.base ? d3.area().y0(p => this.y(p[2])).y1(p => this.y(p[1])) : d3.line().y(p => this.y(p[1]));
      const path = this.svg.append("path").attr("d", shape.x(p => this.x(p[0])).defined(p => p[1] !== null)(points));
      if (line.base) path.attr("fill", line.colour).attr("fill-opacity", 0.75);
      else path.attr("fill", "none").attr("stroke", line.colour).attr("stroke-width", 1.6).attr("stroke-dasharray", line.dash);
    }
    this.cursor = this.svg.append("line").attr("y1", top).attr("y2", height - bottom).attr("stroke", "currentColor").attr("stroke-width", 1);
    const rows = this.keys.selectAll("span").data(this.lines).enter().append("span");
    rows.append("i").style("background", line => line.dash ? "none" : line.colour).style("border", line => `2px ${line.dash ? "dashed" : "solid"} ${line.colour}`);
    rows.append("span").attr("class", "value");
    const svg = this.svg;
    svg.on("pointermove", () => {
      if (d3.event.pressure === 0 && d3.event.pointerType === "mouse" && d3.event.buttons !== 1) this.show(this.x.invert(d3.mouse(svg.node())[0]), true);
      else if (d3.event.buttons === 1) go_to(this.x.invert(d3.mouse(svg.node())[0]));
    });
    svg.on("pointerdown", () => go_to(this.x.invert(d3.mouse(svg.node())[0])));
    svg.on("pointerleave", () => this.show(this.time, false));
  }

  static lines_of({data, name}, r) {
    const prefix = name ? `${name}: ` : "", dash = r > 0 ? "5 3" : null, {times} = data, sum = times.map(() => 0);
    const is_stacked = data.curves.some(one => one.is_part);
    const lines = data.curves.map((one, k) => {
      const line = {name: prefix + one.name, times, own: one.values, values: one.values, colour: Diagram.colours[k % Diagram.colours.length], dash};
      if (!one.is_part) return is_stacked ? {...line, colour: "currentColor", dash: "2 3"} : line;
      const base = sum.slice();
      one.values.forEach((value, i) => sum[i] += value);
      return {...line, base, values: sum.slice()};
    });
    return is_stacked && r > 0 ? [{name: `${prefix}sum`, times, own: sum, values: sum, colour: "currentColor", dash}] : lines;
  }

  /** The values at a time: those of the last picture not after it. */
  show(time, is_pointed_at = false) {
    if (!is_pointed_at) this.time = time;
    const x = this.x(time);
    this.cursor.attr("x1", x).attr("x2", x);
    this.keys.selectAll(".value").text(line => {
      const k = Math.max(0, d3.bisectRight(line.times, time * (1 + 1e-12)) - 1), value = line.own[k];
      return `${line.name} ${value === null || value === undefined ? "none" : BodyView.in_words(value)}`;
    });
  }
}
