// The page works without this script. A link to a folded part opens that part. On a narrow screen, the contents are
// folded at the start.
function unfold() {
  const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
  if (!target) return;
  let folded = false;
  for (let e = target; e; e = e.parentElement)
    if (e.tagName === "DETAILS" && !e.open) e.open = folded = true;
  if (folded) target.scrollIntoView();
}
addEventListener("hashchange", unfold);
addEventListener("beforeprint", () => document.querySelectorAll("#cost details, .reference details").forEach(e => e.open = true));
unfold();
const contents = document.querySelector(".contents details");
if (contents && matchMedia("(max-width: 70rem)").matches) contents.open = false;

const svgns = "http://www.w3.org/2000/svg";
function made(parent, name, attributes = {}, text = "") {
  const svg = parent.namespaceURI === svgns || name === "svg";
  const e = svg ? document.createElementNS(svgns, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.textContent = text;
  return parent.appendChild(e);
}

// Shows the values of all curves at the pointer, or at the position that the arrow keys select. The user can enlarge a
// part of the drawing by drawing a frame or by pressing keys.
function readable(svg) {
  const [x0, x1, y0, y1, left, right, bottom, top, logX, logY] = svg.dataset.axes.split(" ").map(Number);
  const box = svg.parentElement, none = ["#ffffff", "#e4e7eb", "#a6aeb8", "#eef0f3"];
  const inside = p => p[0] >= left - 1 && p[0] <= right + 1 && p[1] >= top - 1 && p[1] <= bottom + 1;
  const value = (share, from, to, log) => log ? from * (to / from) ** share : from + share * (to - from);
  const curves = [...svg.querySelectorAll("path[stroke]")].filter(p => !none.includes(p.getAttribute("stroke")))
    .map(p => ({color: p.getAttribute("stroke"), dash: p.getAttribute("stroke-dasharray"), pieces: p.getAttribute("d").split("M").slice(1).map(piece =>
      (piece.match(/-?[\d.]+,-?[\d.]+/g) || []).map(pair => pair.split(",").map(Number)))}))
    .filter(c => c.pieces.some(piece => piece.length > 1 && piece.every(inside)));
  if (!curves.length) return;
  const at = (curve, x) => {
    for (const piece of curve.pieces)
      for (let i = 1; i < piece.length; ++i) {
        const [a, b] = [piece[i - 1], piece[i]];
        if ((a[0] - x) * (b[0] - x) <= 0 && a[0] !== b[0]) return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
      }
  };
  box.tabIndex = 0;
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", svg.getAttribute("aria-label") + " Arrow keys read values, + and - zoom, 0 shows all.");
  const line = made(svg, "path", {stroke: "#5b6470", "stroke-width": 1, "stroke-dasharray": "3 3", d: ""});
  const out = made(box, "output", {class: "reading"});
  let here = (left + right) / 2;
  const words = n => String(Number(n.toPrecision(4)));
  const show = (x, y) => {
    here = Math.min(right, Math.max(left, x));
    line.setAttribute("d", `M${here},${top}V${bottom}`);
    const seen = curves.map(c => [c, at(c, here)]).filter(([, y]) => y !== undefined).sort((a, b) => a[1] - b[1]);
    out.textContent = `${svg.dataset.x} ${words(value((here - left) / (right - left), x0, x1, logX))}; ${svg.dataset.y}`;
    for (const [curve, at] of seen.slice(0, 12)) {
      const row = made(out, "span");
      made(made(row, "svg", {viewBox: "0 0 20 4", "aria-hidden": "true"}), "path",
        {stroke: curve.color, "stroke-width": 3, "stroke-dasharray": curve.dash || "none", d: "M0,2H20"});
      row.append(words(value((bottom - at) / (bottom - top), y0, y1, logY)));
    }
    out.style.left = here > (left + right) / 2 ? "2%" : "";
    out.hidden = false;
  };
  const hide = () => { out.hidden = true; line.setAttribute("d", ""); };
  hide();
  const whole = svg.getAttribute("viewBox").split(/[ ,]+/).map(Number), framed = made(svg, "path", {stroke: "#5b6470", fill: "none", d: ""});
  let seen = whole, from;
  const zoom = (x, y, width) => {
    const w = Math.min(whole[2], Math.max(whole[2] / 64, width)), h = w * whole[3] / whole[2];
    const within = (middle, size, start, all) => Math.min(start + all - size, Math.max(start, middle - size / 2));
    seen = [within(x, w, whole[0], whole[2]), within(y, h, whole[1], whole[3]), w, h];
    svg.setAttribute("viewBox", seen.join(" "));
  };
  const place = e => new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
  svg.addEventListener("pointerdown", e => { if (e.pointerType !== "touch" && e.button === 0) { from = place(e); e.preventDefault(); box.focus(); } });
  svg.addEventListener("pointermove", e => {
    const p = place(e);
    framed.setAttribute("d", from ? `M${from.x},${from.y}H${p.x}V${p.y}H${from.x}Z` : "");
    inside([p.x, p.y]) ? show(p.x) : hide();
  });
  svg.addEventListener("pointerup", e => {
    const p = place(e), width = from ? Math.max(Math.abs(p.x - from.x), Math.abs(p.y - from.y) * whole[2] / whole[3]) : 0;
    if (width > seen[2] / 50) zoom((p.x + from.x) / 2, (p.y + from.y) / 2, width);
    from = undefined;
    framed.setAttribute("d", "");
  });
  svg.addEventListener("dblclick", () => zoom(0, 0, whole[2]));
  svg.addEventListener("pointerleave", () => { from = undefined; framed.setAttribute("d", ""); hide(); });
  box.addEventListener("blur", hide);
  box.addEventListener("keydown", e => {
    const step = {ArrowLeft: -1, ArrowRight: 1}[e.key], factor = {"+": 0.5, "-": 2, 0: 64}[e.key];
    if (!step && !factor) return;
    e.preventDefault();
    if (factor) return zoom(here, at(curves[0], here) ?? (top + bottom) / 2, seen[2] * factor);
    show(here + step * (right - left) / 50 * seen[2] / whole[2]);
  });
}
document.querySelectorAll("figure svg[data-axes]").forEach(readable);

// Animates motions. If the reader prefers reduced motion, a button starts them.
function outlines(parent, drawn, color) {
  const paths = color ? [["fill", {fill: "#dde6f0", "fill-rule": "evenodd"}], ["edges", {stroke: color, "stroke-width": 12}],
    ["lines", {stroke: color, "stroke-width": 22, "stroke-linejoin": "round"}]] : ["edges", "lines"].map(name => [name, {stroke: "#a6aeb8", "stroke-width": 11}]);
  const all = paths.map(([name, style]) => [made(parent, "path", {fill: "none", ...style}), drawn[name]]);
  return at => all.forEach(([path, lines]) => path.setAttribute("d",
    lines.map(line => "M" + line.map(i => at[2 * i].toFixed() + "," + at[2 * i + 1].toFixed()).join("L")).join("")));
}
// Returns the duration of a repeated motion, the factor by which it is slowed down, and a function that draws its state
// at a time.
function running(motion, g) {
  const sums = rows => rows.slice(1).reduce((all, row) => [...all, row.map((step, i) => all.at(-1)[i] + step)], [rows[0]]);
  const text = made(g, "text", {x: motion.panel[0] / 2, y: -70}), times = motion.times, start = times[0], length = times.at(-1) - start;
  const sets = [motion.still && [sums(motion.still), outlines(g, motion)], [sums(motion.moved), outlines(g, motion, "#1f5fa8")]].filter(Boolean);
  return {length, slowed: 4 / length, draw: t => {
    const now = start + t % length, k = Math.max(1, times.findIndex(time => time >= now)), share = (now - times[k - 1]) / (times[k] - times[k - 1]);
    text.textContent = `${Number(now.toPrecision(3))} s`;
    for (const [rows, show] of sets) show(rows[k].map((x, i) => share * x + (1 - share) * rows[k - 1][i]));
  }};
}
function moving(svg) {
  const data = JSON.parse(svg.querySelector("metadata").textContent), [width, height] = data.panel;
  const head = 240;
  const picture = made(svg.parentElement, "svg", {viewBox: `0 0 ${width} ${height + head}`, role: "img",
    "aria-label": svg.getAttribute("aria-label"), "font-family": "Helvetica, Arial, sans-serif", fill: "none", class: "moving"});
  const {draw, slowed, length} = running(data, made(picture, "g", {fill: "#1d232b", "font-size": 150, "text-anchor": "middle",
    transform: `translate(0,${head})`}));
  const bar = made(svg.parentElement, "p", {class: "motion"}), button = made(bar, "button", {type: "button"});
  const slider = (name, before, after, values) => {
    const label = made(bar, "label", {}, before), input = made(label, "input", {type: "range", name, ...values});
    label.append(after);
    return input;
  };
  const speed = slider("speed", "slower ", " faster", {min: -1, max: 1, step: 0.1, value: 0});
  const time = slider("time", "time ", "", {min: 0, max: 1, step: 0.01, value: 0});
  const said = made(bar, "span");
  let t = 0, before, wanted = !matchMedia("(prefers-reduced-motion: reduce)").matches, seen = false, isRunning = false;
  const slower = () => slowed / 10 ** speed.value;
  const step = now => {
    isRunning = wanted && seen;
    if (before !== undefined) t += Math.min(now - before, 100) / 1000 / slower();
    before = isRunning ? now : undefined;
    if (isRunning) time.value = t % length / length;
    draw(t);
    if (isRunning) requestAnimationFrame(step);
  };
  const update = () => {
    button.textContent = wanted ? "Stop" : "Move";
    const n = slower();
    said.textContent = n >= 1 ? `slowed down ${Number(n.toPrecision(2))} times` : `sped up ${Number((1 / n).toPrecision(2))} times`;
    if (wanted && seen && !isRunning) { isRunning = true; requestAnimationFrame(step); }
  };
  button.addEventListener("click", () => { wanted = !wanted; update(); });
  speed.addEventListener("input", update);
  time.addEventListener("input", () => { wanted = false; before = undefined; t = 0.999999 * time.value * length; draw(t); update(); });
  new IntersectionObserver(entries => { seen = entries.at(-1).isIntersecting; update(); }).observe(picture);
  svg.classList.add("still");
  draw(0);
  update();
}
for (const data of document.querySelectorAll("figure svg metadata")) moving(data.parentElement);

// Search over all checks. Their list is loaded when the form is first used.
const find = document.getElementById("find");
if (find) {
  const form = find.querySelector("form"), body = find.querySelector("tbody"), status = find.querySelector("[role=status]");
  const most = 100;
  const tidy = text => text.toLowerCase();
  const search = () => {
    const {cases, statuses, roles, rows} = window.trammelChecks, asked = new FormData(form);
    const words = tidy(asked.get("text")).split(/\s+/).filter(Boolean);
    const hit = rows.filter(([c, variant, title, quantity, role, state]) => {
      const [id, name, family, labels] = cases[c];
      const is = (key, value) => !asked.get(key) || asked.get(key) === value;
      if (!is("family", family) || !is("role", roles[role]) || !is("verdict", statuses[state][0])) return false;
      if (asked.get("label") && !labels.includes(asked.get("label"))) return false;
      const all = tidy([id, name, variant, title, quantity].join(" "));
      return words.every(word => all.includes(word));
    });
    const share = row => row[6] ?? (statuses[row[5]][1] === "passes" ? -1 : 1e99);  // without a fraction, only the status counts
    if (asked.get("order") === "worst") hit.sort((a, b) => statuses[b[5]][3] - statuses[a[5]][3] || share(b) - share(a));
    status.textContent = `${hit.length} of ${rows.length} checks` + (hit.length > most ? `, the first ${most}` : "");
    body.replaceChildren();
    for (const [c, variant, title, quantity, role, state, share, anchor] of hit.slice(0, most)) {
      const [id, name, , , page] = cases[c], [words, css, sign] = statuses[state], row = made(body, "tr", {class: css});
      const verdict = made(row, "td", {class: "verdict"});
      made(verdict, "span", {class: "mark " + css, "aria-hidden": "true"}, sign);
      verdict.append(words);
      const check = made(row, "th", {scope: "row"}), place = made(row, "td");
      made(check, "a", {href: `${page}#check-${anchor}`}, title);
      made(check, "span", {class: "muted partial"}, `${quantity}, ${roles[role]}`);
      place.append(name + (variant === "base" ? "" : ", " + variant));
      made(place, "code", {}, `./trammel run ${id}` + (variant === "base" ? "" : ` --variant ${variant}`));
      made(row, "td", {class: "number"}, share === null ? "–" : String(share));
    }
  };
  const fill = () => {
    const {cases, statuses, roles} = window.trammelChecks;
    const sorted = values => [...new Set(values)].sort();
    const options = {family: sorted(cases.map(c => c[2])), role: roles, verdict: statuses.map(s => s[0]), label: sorted(cases.flatMap(c => c[3]))};
    for (const [name, values] of Object.entries(options))
      for (const value of values) made(form.elements[name], "option", {}, value);
    find.querySelector(".scroll").hidden = false;
    search();
  };
  form.addEventListener("submit", e => e.preventDefault());
  form.addEventListener("input", () => window.trammelChecks && search());
  form.addEventListener("focusin", () => {
    const list = find.querySelector("template");
    if (!list) return;
    const script = list.content.firstElementChild;
    list.remove();
    find.append(script);
    script.addEventListener("load", fill);
  });
  find.hidden = false;
  if (location.hash === "#find") form.elements.text.focus();
}
