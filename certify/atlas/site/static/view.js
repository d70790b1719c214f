// @ts-check
// The view in space: what is shown is a function of the controls, drawn anew at each change.
"use strict";

/* global Plotly */

(() => {
  /** @typedef {[number, number, number]} Point */
  /**
   * @typedef {object} Scene
   * @property {string} name
   * @property {number[][]} tetrahedra
   * @property {string[]} types
   * @property {number[][]} near
   * @property {number[][]} facets
   * @property {Point[]} corners
   * @property {{questions: string[], points: Point[], best: Point[]}[]} witnesses the points of the
   *   yeses: as they are, and as they look best
   */
  const element = (/** @type {string} */ id) => /** @type {HTMLElement} */ (document.getElementById(id));
  const input = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id));
  /** @type {Scene} */
  const scene = JSON.parse(element("scene").textContent ?? "");
  const view = element("view");
  const form = /** @type {HTMLFormElement} */ (element("controls"));
  const witness = /** @type {HTMLSelectElement} */ (element("witness"));
  const GRID = 13;
  /** @type {Set<number>} */
  const hidden = new Set();
  /** What is drawn fits into a sphere of the diameter 1; so far away all of it is in sight. */
  function farEnough() {
    const half = Math.tan(Math.PI / 8); // plotly's angle of view, from bottom to top, is 45 degrees
    const narrow = Math.min(1, view.clientWidth / Math.max(1, view.clientHeight));
    return 0.5 / Math.sin(Math.atan(half * narrow));
  }

  const from = farEnough() / Math.hypot(0.9, -1.3, 0.75);
  /** From where it is looked at; plotly tells when the reader turns it. */
  let camera = {
    eye: { x: 0.9 * from, y: -1.3 * from, z: 0.75 * from },
    center: { x: 0, y: 0, z: 0 },
    up: { x: 0, y: 0, z: 1 },
    projection: { type: "perspective" },
  };

  // Geometry.

  /** @param {Point[]} points @returns {Point} */
  function middle(points) {
    const sum = (/** @type {number} */ axis) => points.reduce((s, p) => s + p[axis], 0);
    return [sum(0) / points.length, sum(1) / points.length, sum(2) / points.length];
  }

  /** Move the corners of a tetrahedron away from the middle of all. */
  function moved(/** @type {Point[]} */ points, /** @type {number} */ k, /** @type {number} */ by) {
    const own = scene.tetrahedra[k].map((vertex) => points[vertex - 1]);
    const [whole, part] = [middle(points), middle(own)];
    return own.map((p) => p.map((x, axis) => x + by * (part[axis] - whole[axis])));
  }

  /** The weights of the eight vertices at (u, v, w) of the cube, and their derivatives. */
  function weights(/** @type {Point} */ at, /** @type {number} */ along = -1) {
    return scene.corners.map((corner) =>
      corner.reduce((product, bit, axis) => {
        if (axis === along) return product * (bit ? 1 : -1);
        return product * (bit ? at[axis] : 1 - at[axis]);
      }, 1),
    );
  }

  /** @param {Point[]} points @param {number[]} factors @returns {Point} */
  function combined(points, factors) {
    const sum = (/** @type {number} */ axis) => points.reduce((s, p, k) => s + factors[k] * p[axis], 0);
    return [sum(0), sum(1), sum(2)];
  }

  /** The Jacobian of the trilinear map at (u, v, w). */
  function jacobian(/** @type {Point[]} */ points, /** @type {Point} */ at) {
    const [a, b, c] = [0, 1, 2].map((axis) => combined(points, weights(at, axis)));
    return (
      a[0] * (b[1] * c[2] - b[2] * c[1]) -
      a[1] * (b[0] * c[2] - b[2] * c[0]) +
      a[2] * (b[0] * c[1] - b[1] * c[0])
    );
  }

  /** @returns {Point[][]} places of the cube on one of its facets */
  function facetGrid(/** @type {number[]} */ facet) {
    const [a, b, c, d] = facet.map((vertex) => scene.corners[vertex - 1]);
    const steps = Array.from({ length: GRID }, (_, k) => k / (GRID - 1));
    return steps.map((s) =>
      steps.map((t) => {
        const at = (/** @type {number} */ axis) =>
          (1 - s) * (1 - t) * a[axis] + s * (1 - t) * b[axis] + s * t * c[axis] + (1 - s) * t * d[axis];
        return /** @type {Point} */ ([at(0), at(1), at(2)]);
      }),
    );
  }

  // Kinds of edges.

  /** @returns {"hexahedron" | "diagonal" | "inner"} */
  function kindOf(/** @type {number} */ a, /** @type {number} */ b) {
    const differ = scene.corners[a - 1].filter((bit, axis) => bit !== scene.corners[b - 1][axis]);
    return differ.length === 1 ? "hexahedron" : differ.length === 2 ? "diagonal" : "inner";
  }

  // Traces.

  const colour = (/** @type {string} */ name) =>
    getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const column = (/** @type {number[][]} */ points, /** @type {number} */ axis) => points.map((p) => p[axis]);
  const digits = (/** @type {number} */ k) => scene.tetrahedra[k].join("");

  function solids(/** @type {Point[]} */ points, /** @type {number} */ apart, /** @type {number} */ opacity) {
    return scene.tetrahedra.map((_, k) => {
      const own = moved(points, k, apart);
      return {
        type: "mesh3d",
        name: digits(k),
        meta: k,
        x: column(own, 0),
        y: column(own, 1),
        z: column(own, 2),
        i: [0, 0, 0, 1],
        j: [1, 1, 2, 2],
        k: [2, 3, 3, 3],
        color: colour(scene.types[k].replace(" ", "-")),
        opacity,
        flatshading: true,
        lighting: { ambient: 0.85, diffuse: 0.4, specular: 0.05 },
        visible: !hidden.has(k),
        hovertemplate: `${digits(k)}, ${scene.types[k]}<extra></extra>`,
      };
    });
  }

  function lines(/** @type {Point[]} */ points, /** @type {number} */ apart) {
    /** @type {Record<string, (number[] | null)[]>} */
    const drawn = { hexahedron: [], diagonal: [], inner: [] };
    scene.tetrahedra.forEach((tetrahedron, k) => {
      if (hidden.has(k)) return;
      const own = moved(points, k, apart);
      for (let a = 0; a < 4; a++) {
        for (let b = a + 1; b < 4; b++) {
          drawn[kindOf(tetrahedron[a], tetrahedron[b])].push(own[a], own[b], null);
        }
      }
    });
    return Object.entries(drawn).map(([kind, places]) => ({
      type: "scatter3d",
      mode: "lines",
      name: kind,
      x: places.map((p) => p && p[0]),
      y: places.map((p) => p && p[1]),
      z: places.map((p) => p && p[2]),
      line: { color: colour(kind), width: kind === "hexahedron" ? 5 : 3 },
      hoverinfo: "skip",
    }));
  }

  /** The sides of the box around points, over the diameter of the sphere around its middle. */
  function proportions(/** @type {number[][]} */ points) {
    const axes = [0, 1, 2].map((axis) => column(points, axis));
    const [low, high] = [axes.map((a) => Math.min(...a)), axes.map((a) => Math.max(...a))];
    const away = (/** @type {number[]} */ p) =>
      Math.hypot(...p.map((x, axis) => x - (low[axis] + high[axis]) / 2));
    const radius = Math.max(...points.map(away));
    const [x, y, z] = high.map((h, axis) => (h - low[axis]) / (2 * radius));
    return { ratio: { x, y, z }, radius };
  }

  /** Vertex numbers: once at each place where a shown tetrahedron has the vertex, a bit outside. */
  function numbers(/** @type {Point[]} */ points, /** @type {number} */ apart) {
    /** @type {Map<string, {at: number[], text: string}>} */
    const labels = new Map();
    scene.tetrahedra.forEach((tetrahedron, k) => {
      if (hidden.has(k)) return;
      moved(points, k, apart).forEach((at, n) => {
        labels.set(`${tetrahedron[n]} ${at.map((x) => x.toFixed(4))}`, { at, text: String(tetrahedron[n]) });
      });
    });
    const all = [...labels.values()];
    const whole = middle(points);
    const { radius } = proportions(points);
    const outside = (/** @type {number[]} */ at) => {
      const away = at.map((x, axis) => x - whole[axis]);
      const by = 1 + (0.09 * radius) / (Math.hypot(...away) || 1);
      return away.map((x, axis) => whole[axis] + by * x);
    };
    const places = all.map((label) => outside(label.at));
    return {
      type: "scatter3d",
      mode: "text",
      name: "vertices",
      x: column(places, 0),
      y: column(places, 1),
      z: column(places, 2),
      text: all.map((label) => label.text),
      textposition: "middle center",
      textfont: { size: apart ? 12 : 16, color: colour("ink") },
      hoverinfo: "skip",
    };
  }

  /** The six facets as the trilinear map makes them, plain or coloured by the Jacobian. */
  function facets(/** @type {Point[]} */ points, /** @type {boolean} */ coloured) {
    const grids = scene.facets.map(facetGrid);
    const values = grids.map((grid) => grid.map((row) => row.map((at) => jacobian(points, at))));
    const [least, most] = [Math.min(...values.flat(2)), Math.max(...values.flat(2))];
    const scale = element("scale");
    scale.hidden = !coloured;
    scale.textContent =
      least > 0
        ? `On the facets the Jacobian lies between 1 (dark) and ${(most / least).toPrecision(3)} (light), if its least value is 1.`
        : "Where the Jacobian is negative the facets are red.";
    const plain = colour("facet");
    return grids.map((grid, n) => {
      const places = grid.map((row) => row.map((at) => combined(points, weights(at))));
      const along = (/** @type {number} */ axis) => places.map((row) => row.map((p) => p[axis]));
      return {
        type: "surface",
        name: `facet ${scene.facets[n].join("")}`,
        x: along(0),
        y: along(1),
        z: along(2),
        surfacecolor: values[n].map((row) => row.map((j) => (coloured ? (j < 0 ? -1 : j / most) : 0))),
        cmin: coloured ? -1 : 0,
        cmax: 1,
        colorscale: coloured
          ? [[0, "#b3203a"], [0.5, "#b3203a"], [0.5, "#2c3e77"], [0.75, "#2f9c95"], [1, "#f5e88a"]]
          : [[0, plain], [1, plain]],
        opacity: coloured ? 1 : 0.55,
        showscale: false,
        hoverinfo: "skip",
      };
    });
  }

  // The drawing.

  function draw() {
    const own = scene.witnesses[Number(witness.value)];
    const points = input("true").checked ? own.points : own.best;
    const apart = Number(input("apart").value);
    const [curved, coloured] = [input("curved").checked, input("jacobian").checked];
    const traces = [
      ...solids(points, apart, coloured ? 0 : curved ? 0.15 : 1),
      ...lines(points, apart),
      numbers(points, apart),
      ...(curved ? facets(points, coloured) : []),
    ];
    if (!curved) element("scale").hidden = true;
    const drawn = scene.tetrahedra.flatMap((_, k) => moved(points, k, apart));
    const axis = { visible: false, showspikes: false };
    const layout = {
      margin: { l: 0, r: 0, t: 0, b: 0 },
      paper_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      scene: {
        xaxis: axis,
        yaxis: axis,
        zaxis: axis,
        aspectmode: "manual",
        aspectratio: proportions(drawn).ratio,
        camera,
      },
      hoverlabel: { font: { size: 14 } },
    };
    const options = { responsive: true, displaylogo: false, displayModeBar: false };
    return Plotly.react(view, traces, layout, options);
  }

  // The controls.

  function list() {
    const rows = scene.tetrahedra.map((_, k) => {
      const row = document.createElement("p");
      const shown = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.dataset.tetrahedron = String(k);
      box.checked = !hidden.has(k);
      box.addEventListener("change", () => hide(k, !box.checked));
      const swatch = document.createElement("span");
      swatch.className = `swatch ${scene.types[k].replace(" ", "-")}`;
      shown.append(box, swatch, digits(k));
      const near = document.createElement("button");
      near.type = "button";
      near.textContent = "neighbours";
      near.setAttribute("aria-label", `Show ${digits(k)} and its neighbours alone`);
      near.addEventListener("click", () => showNear(k));
      row.append(shown, near);
      return row;
    });
    element("tetrahedra").replaceChildren(...rows);
  }

  function mark() {
    for (const box of form.querySelectorAll("input[data-tetrahedron]")) {
      if (box instanceof HTMLInputElement) box.checked = !hidden.has(Number(box.dataset.tetrahedron));
    }
    draw();
  }

  function hide(/** @type {number} */ k, /** @type {boolean} */ now) {
    if (now) hidden.add(k);
    else hidden.delete(k);
    mark();
  }

  function showNear(/** @type {number} */ k) {
    scene.tetrahedra.forEach((_, other) => {
      if (other === k || scene.near[k].includes(other)) hidden.delete(other);
      else hidden.add(other);
    });
    mark();
  }

  /** Turn about the vertical, tilt, or come nearer. */
  function turn(/** @type {string} */ how) {
    const { x, y, z } = camera.eye;
    let [around, above, far] = [Math.atan2(y, x), Math.atan2(z, Math.hypot(x, y)), Math.hypot(x, y, z)];
    const step = Math.PI / 12;
    const moves = { left: [-step, 0, 1], right: [step, 0, 1], up: [0, step, 1], down: [0, -step, 1] };
    const zooms = { in: [0, 0, 1 / 1.2], out: [0, 0, 1.2] };
    const [a, b, f] = { ...moves, ...zooms }[how] ?? [0, 0, 1];
    around += a;
    above = Math.max(-1.5, Math.min(1.5, above + b));
    far *= f;
    const eye = {
      x: far * Math.cos(above) * Math.cos(around),
      y: far * Math.cos(above) * Math.sin(around),
      z: far * Math.sin(above),
    };
    camera = { ...camera, eye };
    draw();
  }

  scene.witnesses.forEach((own, k) => witness.add(new Option(own.questions.join(", "), String(k))));
  witness.value = String(scene.witnesses.length - 1);
  form.hidden = false;
  list();
  input("jacobian").addEventListener("change", () => {
    if (input("jacobian").checked) input("curved").checked = true;
  });
  input("curved").addEventListener("change", () => {
    if (!input("curved").checked) input("jacobian").checked = false;
  });
  for (const id of ["apart", "witness", "curved", "jacobian", "true"]) {
    element(id).addEventListener("input", draw);
    element(id).addEventListener("change", draw);
  }
  element("all").addEventListener("click", () => {
    hidden.clear();
    mark();
  });
  for (const button of form.querySelectorAll("button[data-turn]")) {
    button.addEventListener("click", () => turn(/** @type {HTMLElement} */ (button).dataset.turn ?? ""));
  }
  window.addEventListener("themechange", draw);
  draw().then(() => {
    /** @type {any} */ (view).on("plotly_relayout", (/** @type {any} */ event) => {
      camera = event["scene.camera"] ?? camera;
    });
    /** @type {any} */ (view).on("plotly_click", (/** @type {any} */ event) => {
      const k = event.points[0]?.data.meta;
      if (typeof k !== "number") return;
      const how = new FormData(form).get("click");
      // Not while plotly is still busy with the click.
      setTimeout(() => (how === "near" ? showNear(k) : hide(k, true)));
    });
  });
})();
