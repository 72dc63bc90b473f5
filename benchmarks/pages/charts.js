"use strict";

/** A diagram of a study (findings.cpp): curves and points on axes, of which one is put forward when it is pointed at. */
class Chart {
  static draw(figure, diagram) {
    const element = d3.select(figure);
    if (diagram.kind === "plot") {
      new Chart(element, {...diagram, title: ""}, {width: 1100, height: 560}, null);
      if (diagram.subtitle) element.append("p").attr("class", "note").text(diagram.subtitle);
    }
    if (diagram.kind !== "panels") return;
    const panels = element.append("div").attr("class", "panels");
    for (const panel of diagram.panels) new Chart(panels.append("div"), panel, {width: 560, height: 380}, diagram.field);
    if (diagram.field.label && diagram.panels.some(panel => panel.field.values.length))
      element.append("p").attr("class", "note").text(`Colours: ${diagram.field.label}, from ${diagram.field.low} (blue) to ${diagram.field.high} (red).`);
  }

  /** A colour that is seen in the dark, too: black and dark greys are those of the text. */
  static ink(colour) {
    const {r, g, b} = d3.rgb(colour);
    return Math.max(r, g, b) < 0x50 ? "currentColor" : colour;
  }

  static scale(axis, range) {
    return (axis.log ? d3.scaleLog() : d3.scaleLinear()).domain([axis.low, axis.high]).range(range);
  }

  constructor(parent, data, {width, height}, field) {
    const rows = data.rows || [], left = rows.length ? 190 : 70, right = 14, top = data.title ? 26 : 10, bottom = 46;
    parent.append("button").attr("type", "button").attr("class", "tools").text("SVG").attr("aria-label", `Save ${data.title || "the diagram"} as SVG`)
      .on("click", () => save_svg(this.svg.node(), data.title || "diagram"));
    this.svg = parent.append("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("xmlns", "http://www.w3.org/2000/svg").attr("role", "img")
      .attr("font-family", "sans-serif").attr("font-size", 12);
    this.svg.append("title").text(`${data.title} ${data.y.title} against ${data.x.title}: ${data.series.map(s => s.title).filter(t => t).join(", ")}`);
    if (data.title) this.svg.append("text").attr("x", (width + left) / 2).attr("y", 15).attr("text-anchor", "middle").attr("fill", "currentColor").attr("font-size", 14).text(data.title);
    this.x = Chart.scale(data.x, [left, width - right]);
    this.y = Chart.scale(data.y, [height - bottom, top]);
    if (data.field && data.field.values.length) this.draw_field(data.field, field);
    if (data.shaded_below > 0) {
      const edge = this.y(data.shaded_below);
      this.svg.append("rect").attr("x", left).attr("width", width - left - right).attr("y", edge).attr("height", Math.max(0, height - bottom - edge)).attr("fill", "currentColor").attr("opacity", 0.08);
      this.svg.append("text").attr("x", left + 8).attr("y", edge + 16).attr("fill", "currentColor").text(data.shaded_label);
    }
    const axis = (made, place) => this.svg.append("g").attr("transform", place).call(made).attr("font-size", 11).attr("font-family", "sans-serif");
    const ticks = (made, of) => of.log && of.high / of.low > 20 ? made.ticks(6, "~e") : made.ticks(6, "~g");
    axis(ticks(d3.axisBottom(this.x), data.x), `translate(0,${height - bottom})`);
    let of_y = ticks(d3.axisLeft(this.y), data.y);
    if (rows.length) of_y = d3.axisLeft(this.y).tickValues(rows.map((r, k) => k + 1)).tickFormat((d, k) => rows[k]);
    else if (data.ticks && data.ticks.length) of_y = d3.axisLeft(this.y).tickValues(data.ticks.map(t => t.at)).tickFormat((d, k) => data.ticks[k].label);
    axis(of_y, `translate(${left},0)`);
    this.svg.append("text").attr("x", (width + left) / 2).attr("y", height - 8).attr("text-anchor", "middle").attr("fill", "currentColor").text(data.x.title);
    this.svg.append("text").attr("transform", `translate(14,${(height - bottom + top) / 2}) rotate(-90)`).attr("text-anchor", "middle").attr("fill", "currentColor")
      .attr("font-size", Math.min(12, 1.8 * (height - bottom - top) / Math.max(1, data.y.title.length))).text(data.y.title);

    const clip = `clip-${++Chart.count}`;
    this.svg.append("clipPath").attr("id", clip).append("rect").attr("x", left - 6).attr("y", top - 6).attr("width", width - left - right + 12).attr("height", height - bottom - top + 12);
    this.series = data.series;
    this.groups = this.series.map(one => this.draw_series(one).attr("clip-path", `url(#${clip})`));
    this.keys = parent.append("div").attr("class", "keys").selectAll("button").data(this.series.filter(one => one.title)).enter().append("button").attr("type", "button");
    this.keys.append("i").style("background", one => Chart.ink(one.colour));
    this.keys.append("span").text(one => one.title);
    this.keys.attr("aria-pressed", "false").on("click", one => this.choose(this.chosen === one ? null : one));
    this.said = parent.append("div").attr("class", "said").attr("role", "status");
    this.chosen = null;
    this.svg.on("pointermove", () => this.point_at(d3.mouse(this.svg.node()))).on("pointerleave", () => this.put_forward(this.chosen));
  }

  draw_field({x, y, values}, {low, high}) {
    const colour = d3.scaleLinear().domain([0, 0.25, 0.5, 0.75, 1]).range(["#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"]).clamp(true);
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [x.length, y.length];
    const context = canvas.getContext("2d");
    values.forEach((value, k) => {
      context.fillStyle = value === null ? "#808080" : colour((value - low) / (high - low));
      context.fillRect(k % x.length, y.length - 1 - Math.floor(k / x.length), 1, 1);
    });
    const half_x = (x[1] - x[0]) / 2 || 0, half_y = (y[1] - y[0]) / 2 || 0;
    const [x0, x1] = [this.x(x[0] - half_x), this.x(x[x.length - 1] + half_x)], [y1, y0] = [this.y(y[0] - half_y), this.y(y[y.length - 1] + half_y)];
    this.svg.append("image").attr("href", canvas.toDataURL()).attr("x", x0).attr("y", y0).attr("width", x1 - x0).attr("height", y1 - y0)
      .attr("preserveAspectRatio", "none").attr("style", "image-rendering: pixelated");
  }

  draw_series(one) {
    const group = this.svg.append("g").attr("opacity", one.opacity);
    const points = one.x.map((x, k) => ({x, y: one.y[k], label: one.labels[k] || ""}))
      .filter(p => p.x !== null && p.y !== null && Number.isFinite(this.x(p.x)) && Number.isFinite(this.y(p.y)));
    const curve = one.staircase ? d3.curveStepAfter : d3.curveLinear;
    const line = d3.line().x(p => this.x(p.x)).y(p => this.y(p.y)).curve(curve);
    if (one.filled) group.append("path").attr("d", d3.area().x(p => this.x(p.x)).y0(this.y(0)).y1(p => this.y(p.y)).curve(curve)(points)).attr("fill", Chart.ink(one.colour));
    else if (one.width > 0) group.append("path").attr("d", line(points)).attr("fill", "none").attr("stroke", Chart.ink(one.colour)).attr("stroke-width", one.width)
      .attr("stroke-dasharray", one.dash ? one.dash.replace(/-/g, "6 4 ").replace(/\./g, "2 3 ").trim() : null);
    if (one.symbol > 0) {
      const is_open = one.symbol % 2 === 0, radius = 3.2 * one.size;
      group.selectAll("circle").data(points).enter().append("circle").attr("cx", p => this.x(p.x)).attr("cy", p => this.y(p.y)).attr("r", radius)
        .attr("fill", is_open ? "none" : Chart.ink(one.colour)).attr("stroke", Chart.ink(one.colour));
    }
    group.selectAll("text").data(points.filter(p => p.label)).enter().append("text").attr("x", p => this.x(p.x) + 6).attr("y", p => this.y(p.y) + 3)
      .attr("font-size", 9).attr("fill", Chart.ink(one.colour)).text(p => p.label);
    one.shown = points;
    return group;
  }

  /** Puts the series of the nearest point forward, and says what that is. */
  point_at([x, y]) {
    let nearest = null, far = 30;
    for (const one of this.series)
      for (const p of one.shown) {
        const d = Math.hypot(this.x(p.x) - x, this.y(p.y) - y);
        if (d < far) [nearest, far] = [{one, p}, d];
      }
    this.put_forward(nearest ? nearest.one : this.chosen);
    const words = v => Number(v.toPrecision(4));
    this.said.text(nearest ? `${nearest.one.title} ${nearest.p.label} (${words(nearest.p.x)}, ${words(nearest.p.y)})` : "");
  }

  choose(one) {
    this.chosen = one;
    this.keys.attr("aria-pressed", other => String(other === one));
    this.put_forward(one);
  }

  put_forward(one) {
    this.groups.forEach((group, k) => group.classed("pale", one !== null && this.series[k] !== one));
    this.keys.classed("pale", other => one !== null && other !== one);
  }
}
Chart.count = 0;
