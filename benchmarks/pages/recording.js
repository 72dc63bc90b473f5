"use strict";

/** A run as its page holds it, decoded when it is asked for. */
class Recording {
  constructor(page) {
    this.title = page.title;
    this.page = page;
    this.run = page.run;
    this.colours = page.colours;
    this.times = this.run.frames.map(frame => frame.time);
    this.shapes = this.run.shapes.map(() => null);
  }

  /** The page in the text of a player's file. */
  static of(text) {
    const held = new DOMParser().parseFromString(text, "text/html").getElementById("page");
    let page = null;
    try {
      page = JSON.parse(held.textContent);
    } catch (error) {
      page = null;
    }
    if (!page || page.format !== "dartboard-player") throw new Error("is no page made by dartboard simulate --player");
    if (page.version !== 1) throw new Error(`has version ${page.version} of the format; this page reads version 1`);
    return new Recording(page);
  }

  static column(text, Type) {
    const letters = atob(text), bytes = new Uint8Array(letters.length);
    for (let k = 0; k < bytes.length; ++k) bytes[k] = letters.charCodeAt(k);
    return new Type(bytes.buffer);
  }

  /** The last frame that is not after a time, or the first. */
  frame_at(time) {
    return Math.max(0, d3.bisectRight(this.times, time * (1 + 1e-12)) - 1);
  }

  /** Facets as triangles, the borders of facets, and the columns of a shape. */
  shape(number) {
    if (this.shapes[number]) return this.shapes[number];
    const raw = this.run.shapes[number], points = raw.points;
    const Index = points <= 0x10000 ? Uint16Array : Uint32Array;
    const bytes = name => Recording.column(raw[name], Uint8Array);
    const shape = {points, number: Recording.column(raw.number, Int32Array), held: bytes("held"), was_inside: bytes("was_inside"),
      dimension: bytes("dimension"), material: bytes("material"), body: bytes("body"),
      component: Recording.column(raw.component, Uint16Array), links: Recording.column(raw.links, Index)};
    const corners = Recording.column(raw.corners, Index), sides = bytes("sides");
    const triangles = [], facet = [], seen = new Set();
    shape.edges = [];
    let first = 0;
    sides.forEach((count, f) => {
      for (let k = 1; k + 1 < count; ++k) {
        triangles.push(corners[first], corners[first + k], corners[first + k + 1]);
        facet.push(f);
      }
      for (let k = 0; k < count; ++k) {
        const a = corners[first + k], b = corners[first + (k + 1) % count];
        const key = Math.min(a, b) * points + Math.max(a, b);
        if (!seen.has(key)) shape.edges.push(a, b);
        seen.add(key);
      }
      first += count;
    });
    shape.triangles = Uint32Array.from(triangles);
    shape.facet = Uint32Array.from(facet);
    shape.facets = sides.length;
    return this.shapes[number] = shape;
  }

  /** [m] Three numbers for each point of a frame. */
  places(number) {
    const column = Recording.column(this.run.frames[number].places, Uint16Array), places = new Float32Array(column.length);
    for (let k = 0; k < column.length; ++k) places[k] = this.run.low[k % 3] + this.run.size[k % 3] * (column[k] / 65535);
    return places;
  }

  /** By point, a share of the largest value from 0 to 1, or NaN where there is none; null without such a quantity. */
  shares(number, quantity) {
    const text = this.run.frames[number].values[quantity];
    return text === undefined ? null : Float32Array.from(Recording.column(text, Uint8Array), b => b === 0 ? NaN : (b - 1) / 254);
  }

  /** Six numbers for each: two places, or a place and a force. */
  arrows(number, name) {
    return Recording.column(this.run.frames[number][name], Float32Array);
  }

  quantity(name) {
    return this.run.quantities.find(one => one.name === name);
  }

  /**
   * The way of a point: in each frame the point that has its number and is nearest to where it was in the next frame on
   * the side of the frame it was picked in; null where no such point can be seen.
   */
  way_of(frame, point) {
    const number = this.shape(this.run.frames[frame].shape).number[point];
    const way = this.run.frames.map(() => null);
    const at = (places, k) => [places[3 * k], places[3 * k + 1], places[3 * k + 2]];
    way[frame] = {point, at: at(this.places(frame), point)};
    const follow = (from, to) => {
      if (!way[from]) return;
      if (this.run.frames[from].shape === this.run.frames[to].shape) {
        const k = way[from].point;
        way[to] = {point: k, at: at(this.places(to), k)};
        return;
      }
      if (number < 0) return;  // made by refinement: nothing tells it from others
      const places = this.places(to);
      let nearest = Infinity;
      this.shape(this.run.frames[to].shape).number.forEach((other, k) => {
        if (other !== number) return;
        const here = at(places, k), far = Math.hypot(...here.map((x, a) => x - way[from].at[a]));
        if (far < nearest) {
          nearest = far;
          way[to] = {point: k, at: here};
        }
      });
    };
    for (let f = frame + 1; f < way.length; ++f) follow(f - 1, f);
    for (let f = frame - 1; f >= 0; --f) follow(f + 1, f);
    return {number, way};
  }
}
