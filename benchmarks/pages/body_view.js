"use strict";

/** One run in a box of the page, seen by a camera that several views share. */
class BodyView {
  constructor(parent, recording, camera) {
    this.recording = recording;
    this.camera = camera;
    this.figure = d3.select(parent).append("figure").attr("class", "view");
    const name = this.figure.append("div").attr("class", "name");
    name.append("span").text(recording.title);
    name.append("small").text(recording.page.facts[1]);
    this.legend = this.figure.append("div").attr("class", "legend");
    this.bar = this.figure.append("div").attr("class", "bar");
    this.bar.append("span");
    this.axes = this.figure.append("svg").attr("viewBox", "-38 -38 76 76").attr("aria-hidden", "true");
    // smooth edges would take a renderer in software half of its time
    this.renderer = new THREE.WebGLRenderer({antialias: !BodyView.is_software(), alpha: true});
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.figure.node().insertBefore(this.renderer.domElement, this.figure.node().firstChild);
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute("role", "img");
    this.printed = this.figure.append("img").attr("class", "printed").attr("alt", "");
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.55));
    this.light = new THREE.DirectionalLight(0xffffff, 0.55);  // moves with the camera
    this.scene.add(this.light);

    const attribute = {vertexColors: THREE.VertexColors};
    this.faces = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshLambertMaterial({...attribute,
      side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    this.edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0x000000, opacity: 0.35, transparent: true}));
    this.links = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(attribute));
    this.joints = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({...attribute, size: 5, sizeAttenuation: false}));
    this.held = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({...attribute, size: 6, sizeAttenuation: false}));
    this.attachments = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: recording.colours.attached}));
    this.loads = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: BodyView.load_colour}));
    this.chosen = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({color: 0xff2020, size: 11, sizeAttenuation: false, depthTest: false}));
    for (const part of this.parts()) {
      part.frustumCulled = false;
      this.scene.add(part);
    }
    this.add_obstacles();
    this.shown = -1;
    // asking for the size in every picture would have the browser lay out the page in each
    new ResizeObserver(() => this.resized()).observe(this.figure.node());
    this.fit();
  }

  static is_software() {
    const gl = document.createElement("canvas").getContext("webgl");
    if (!gl) throw new Error("This browser draws no bodies, as it has no WebGL; the curves below are those of the run");
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return names !== null && /swiftshader|llvmpipe|software/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  }

  static get load_colour() {
    return 0xc07000;
  }

  parts() {
    return [this.faces, this.edges, this.links, this.joints, this.held, this.attachments, this.loads, this.chosen];
  }

  /** [m] The middle of all that the bodies reach, and its half diagonal. */
  static reach(recordings) {
    const box = new THREE.Box3();
    for (const {run} of recordings) {
      box.expandByPoint(new THREE.Vector3(...run.low));
      box.expandByPoint(new THREE.Vector3(...run.low).add(new THREE.Vector3(...run.size)));
    }
    return {box, middle: box.getCenter(new THREE.Vector3()), radius: box.getSize(new THREE.Vector3()).length() / 2 || 1};
  }

  add_obstacles() {
    const {middle, radius} = BodyView.reach([this.recording]);
    this.obstacles = this.recording.run.obstacles.map(one => {
      const vector = name => new THREE.Vector3(...one[name]);
      const material = new THREE.MeshLambertMaterial({color: this.recording.colours.obstacle, side: THREE.DoubleSide,
        transparent: true, opacity: one.kind === "plane" ? 0.5 : 0.8, depthWrite: one.kind !== "plane"});
      let shape = null;
      if (one.kind === "ball") {
        shape = new THREE.Mesh(new THREE.SphereGeometry(one.radius, 48, 24), material);
        shape.position.copy(vector("centre"));
      } else if (one.kind === "block") {
        // what is far from the bodies would only hide them
        const far = new THREE.Vector3(radius, radius, radius).multiplyScalar(2);
        const low = vector("low").max(middle.clone().sub(far)), high = vector("high").min(middle.clone().add(far));
        const size = high.clone().sub(low).max(new THREE.Vector3());
        shape = new THREE.Mesh(new THREE.BoxGeometry(size.x, size.y, size.z), material);
        shape.position.copy(low).add(high).multiplyScalar(0.5);
      } else {
        const normal = vector("normal");
        shape = new THREE.Mesh(new THREE.PlaneGeometry(3 * radius, 3 * radius), material);
        shape.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
        shape.position.copy(middle).addScaledVector(normal, -middle.clone().sub(vector("point")).dot(normal));
      }
      shape.userData = {at: shape.position.clone(), plane: one.kind === "plane"};
      this.scene.add(shape);
      return shape;
    });
  }

  static put(part, name, numbers, items = 3) {
    const old = part.geometry.attributes[name];
    if (old && old.count * items === numbers.length) {
      old.array.set(numbers);
      old.needsUpdate = true;
    } else {
      part.geometry.dispose();
      if (name === "position") part.geometry.deleteAttribute("normal");  // of another number of corners
      part.geometry.setAttribute(name, new THREE.BufferAttribute(numbers instanceof Float32Array ? numbers : Float32Array.from(numbers), items));
    }
  }

  static gathered(points, places) {
    const out = new Float32Array(3 * points.length);
    for (let k = 0; k < points.length; ++k)
      for (let a = 0; a < 3; ++a) out[3 * k + a] = places[3 * points[k] + a];
    return out;
  }

  /** A colour for a share of the largest value. */
  shade(share) {
    const shades = this.recording.colours.shades, at = Math.min(1, Math.max(0, share)) * (shades.length - 1);
    const low = Math.min(shades.length - 2, Math.floor(at));
    return BodyView.rgb(shades[low]).map((x, k) => x + (at - low) * (BodyView.rgb(shades[low + 1])[k] - x));
  }

  static rgb(colour) {
    return [colour >> 16 & 255, colour >> 8 & 255, colour & 255].map(x => x / 255);
  }

  /** Colours of facets and links, without values: three numbers each. */
  base_colours(shape, by) {
    const {numbers, inside} = this.recording.colours;
    const out = new Float32Array(3 * shape.component.length);
    for (let c = 0; c < shape.component.length; ++c) {
      const number = by === "material" ? shape.material[c] : by === "body" ? shape.body[c] : shape.component[c];
      const cut = by === "component" && c < shape.facets && shape.was_inside[c];
      out.set(BodyView.rgb(cut ? inside : numbers[number % numbers.length]), 3 * c);
    }
    return out;
  }

  /** Show a frame; `look` has the quantity `by` with the largest value of the scale, and what is drawn besides. */
  show(number, look) {
    const {run} = this.recording, frame = run.frames[number], shape = this.recording.shape(frame.shape);
    const places = this.recording.places(number), quantity = this.recording.quantity(look.by);
    const shares = quantity ? this.recording.shares(number, look.by) : null;
    const stretch = quantity && look.largest > 0 ? quantity.largest / look.largest : 1;
    const base = this.base_colours(shape, quantity ? "component" : look.by);
    const colour_of = (point, cell, is_link) => {
      const has_value = shares && !Number.isNaN(shares[point]) &&
          (is_link ? quantity.dimension <= 1 : shape.dimension[cell] >= quantity.dimension);
      return has_value ? this.shade(stretch * shares[point]) : base.subarray(3 * cell, 3 * cell + 3);
    };

    BodyView.put(this.faces, "position", BodyView.gathered(shape.triangles, places));
    this.faces.geometry.computeVertexNormals();  // no triangles share one
    const colours = new Float32Array(3 * shape.triangles.length);
    shape.triangles.forEach((point, k) => colours.set(colour_of(point, shape.facet[Math.floor(k / 3)], false), 3 * k));
    BodyView.put(this.faces, "color", colours);
    BodyView.put(this.edges, "position", BodyView.gathered(shape.edges, places));
    const ends = BodyView.gathered(shape.links, places), of_links = new Float32Array(ends.length);
    shape.links.forEach((point, k) => of_links.set(colour_of(point, shape.facets + Math.floor(k / 2), true), 3 * k));
    for (const part of [this.links, this.joints]) {
      BodyView.put(part, "position", ends);
      BodyView.put(part, "color", of_links);
    }
    const marked = [];
    shape.held.forEach((how, k) => how > 0 && marked.push(k));
    const meaning = [null, "held", "driven", "held_in_part"];
    BodyView.put(this.held, "position", BodyView.gathered(marked, places));
    BodyView.put(this.held, "color", Float32Array.from(marked.flatMap(k => BodyView.rgb(this.recording.colours[meaning[shape.held[k]]]))));
    BodyView.put(this.attachments, "position", this.recording.arrows(number, "attachments"));
    BodyView.put(this.loads, "position", this.arrows(this.recording.arrows(number, "loads")));
    this.held.visible = this.attachments.visible = this.loads.visible = look.marks;
    this.edges.visible = look.edges;
    this.obstacles.forEach((one, k) => {
      one.visible = look.obstacles;
      one.position.copy(one.userData.at).add(new THREE.Vector3(...frame.moved[k]));
    });
    const way = this.way && this.way.way[number];
    BodyView.put(this.chosen, "position", Float32Array.from(way ? way.at : []));
    this.shown = number;
    this.places_shown = places;
    this.write_legend(look, quantity);
    this.canvas.setAttribute("aria-label", `${this.recording.title} at ${frame.time} s`);
    this.draw();
  }

  /** Lines from where forces act, of a tenth of the reach for the largest force, with heads. */
  arrows(loads) {
    const {radius} = BodyView.reach([this.recording]), lines = [];
    const all = d3.range(0, loads.length, 6).map(k => loads.subarray(k, k + 6)), size = l => Math.hypot(l[3], l[4], l[5]);
    const largest = Math.max(0, ...all.map(size));
    if (!(largest > 0)) return new Float32Array();
    for (const l of all) {
      const from = new THREE.Vector3(l[0], l[1], l[2]), along = new THREE.Vector3(l[3], l[4], l[5]).multiplyScalar(0.2 * radius / largest);
      const to = from.clone().add(along), length = along.length();
      lines.push(...from.toArray(), ...to.toArray());
      if (length === 0) continue;
      const aside = new THREE.Vector3().crossVectors(along, this.camera.position.clone().sub(from)).setLength(0.18 * length);
      for (const side of [-1, 1])
        lines.push(...to.toArray(), ...to.clone().addScaledVector(along, -0.3).addScaledVector(aside, side).toArray());
    }
    return Float32Array.from(lines);
  }

  write_legend(look, quantity) {
    const {run, colours} = this.recording, shape = this.recording.shape(run.frames[this.shown].shape), rows = [];
    const css = colour => `#${colour.toString(16).padStart(6, "0")}`;
    if (look.by === "component" && shape.was_inside.some(x => x)) rows.push(["was inside", css(colours.inside)]);
    if (look.by === "material" || look.by === "body")
      for (const n of [...new Set(shape[look.by])].sort((a, b) => a - b).slice(0, 7))
        rows.push([`${look.by} ${n}`, css(colours.numbers[n % colours.numbers.length])]);
    if (look.marks) {
      [[1, "held"], [2, "driven"], [3, "held_in_part", "held along some axes"]].forEach(([code, name, text]) => {
        if (shape.held.includes(code)) rows.push([text || name, css(colours[name])]);
      });
      if (run.frames.some(frame => frame.attachments)) rows.push(["attached", css(colours.attached)]);
      if (run.frames.some(frame => frame.loads)) rows.push(["force", css(BodyView.load_colour)]);
    }
    if (look.obstacles && run.obstacles.length) rows.push(["obstacle", css(colours.obstacle)]);
    const key = JSON.stringify([look.by, look.largest, rows]);
    if (key === this.legend_shown) return;
    this.legend_shown = key;
    this.legend.selectAll("*").remove();
    if (quantity) {
      const row = this.legend.append("div");
      row.append("span").text("0 ");
      row.append("span").attr("class", "scale").style("background", `linear-gradient(to right, ${colours.shades.map(css).join(",")})`);
      row.append("span").text(` ${BodyView.in_words(look.largest)} ${quantity.unit}`);
    }
    for (const [text, colour] of rows) {
      const row = this.legend.append("div").text(text);
      row.append("i").style("background", colour);
    }
  }

  static in_words(x) {
    return x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toExponential(2).replace("e+", "e") : String(Number(x.toPrecision(3)));
  }

  fit() {
    const {clientWidth: width, clientHeight: height} = this.figure.node();
    [this.width, this.height] = [Math.max(1, width), Math.max(1, height)];
    this.renderer.setSize(this.width, this.height, false);
  }

  resized() {
    this.fit();
    if (this.shown >= 0) this.draw();
  }

  draw() {
    const {half} = this.camera.userData;  // [m] to the right and upwards
    const per_pixel = 2 * Math.max(half[0] / this.width, half[1] / this.height);
    const camera = this.camera;
    [camera.left, camera.right, camera.bottom, camera.top] = [-this.width, this.width, -this.height, this.height].map(x => x * per_pixel / 2);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const along = axis => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, axis);
    this.light.position.copy(camera.position).sub(camera.userData.target()).setLength(1).addScaledVector(along(1), 0.6).addScaledVector(along(0), -0.4);
    const towards = along(2);
    for (const one of this.obstacles)  // a plane seen from its back hides nothing
      if (one.userData.plane) one.material.opacity = new THREE.Vector3(0, 0, 1).applyQuaternion(one.quaternion).dot(towards) > 0 ? 0.5 : 0.12;
    this.renderer.render(this.scene, camera);
    this.draw_bar(per_pixel / camera.zoom);
    this.draw_axes([0, 1, 2].map(axis => [along(0).getComponent(axis), along(1).getComponent(axis)]));
  }

  /** What is drawn, which browsers keep no longer than until they show it. */
  picture() {
    this.draw();
    return this.canvas.toDataURL();
  }

  /** A bar of 1, 2 or 5 times a power of ten metres. */
  draw_bar(per_pixel) {
    const most = 0.3 * this.width * per_pixel, power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].find(k => k * power <= most) * power;
    const [unit, scale] = [["km", 1e3], ["m", 1], ["mm", 1e-3], ["µm", 1e-6]].find(([, s]) => length >= s * 0.999) || ["nm", 1e-9];
    this.bar.style("width", `${length / per_pixel}px`);
    this.bar.select("span").text(`${Number((length / scale).toPrecision(2))} ${unit}`);
  }

  draw_axes(directions) {
    const axes = this.axes.selectAll("g").data(directions);
    const entered = axes.enter().append("g");
    entered.append("line");
    entered.append("text").attr("text-anchor", "middle").attr("dy", "0.35em").text((d, k) => "xyz"[k]);
    const all = entered.merge(axes);
    all.select("line").attr("x2", d => 24 * d[0]).attr("y2", d => -24 * d[1]);
    all.select("text").attr("x", d => 31 * d[0]).attr("y", d => -31 * d[1]);
  }

  /** The point under a place of the window: a corner of the facet there, or a point of links near it. null: none. */
  point_at(x, y) {
    const box = this.canvas.getBoundingClientRect(), camera = this.camera;
    this.draw();  // another view may have given the camera its own borders
    const at = new THREE.Vector2(2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height);
    const seen = k => {
      const p = new THREE.Vector3().fromArray(this.places_shown, 3 * k).project(camera);
      return Math.hypot((p.x - at.x) * box.width / 2, (p.y - at.y) * box.height / 2);
    };
    const shape = this.recording.shape(this.recording.run.frames[this.shown].shape);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, camera);
    this.faces.geometry.computeBoundingSphere();
    const hit = ray.intersectObject(this.faces)[0];
    let among = hit ? [...shape.triangles.subarray(3 * Math.floor(hit.faceIndex), 3 * Math.floor(hit.faceIndex) + 3)] : [];
    if (!among.length) among = [...new Set(shape.links)].filter(k => seen(k) < 14);
    if (!among.length) among = [...new Set(shape.triangles)].filter(k => seen(k) < 8);
    return among.length ? among.sort((a, b) => seen(a) - seen(b))[0] : null;
  }
}
