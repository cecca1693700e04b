// Tests a report in a browser: search, values on hover and by keys, moving modes, reduced motion,
// no scripts, and axe-core on every kind of page. Arguments: the program, a separate folder, and
// optionally a folder for pictures. puppeteer-core and axe-core are installed from npm. The exit
// status is 77 if puppeteer-core, axe-core or Chromium is not available.
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {join} from "node:path";
import {pathToFileURL} from "node:url";

const [program, folder, pictures] = process.argv.slice(2);
const versions = {"puppeteer-core": "24", "axe-core": "4"};
const browsers = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const chromium = browsers.find(existsSync);
mkdirSync(folder, {recursive: true});
const wanted = Object.entries(versions).filter(([name]) => !existsSync(join(folder, "node_modules", name)));
try {
  if (!chromium) throw "no Chromium";
  if (wanted.length)
    execFileSync("npm", ["install", "--no-audit", "--no-fund", "--prefix", folder, ...wanted.map(e => e.join("@"))], {stdio: "ignore"});
} catch (error) {
  console.log(`skipped: ${error}`);
  process.exit(77);
}
const require = createRequire(pathToFileURL(join(folder, "package.json")));
const puppeteer = require("puppeteer-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const out = join(folder, "report");
execFileSync(program, ["report", "manipulator-modes", "circle-load", "elastodynamics-circle", "--out", out], {stdio: "inherit"});
const at = name => pathToFileURL(join(out, name)).href;
const browser = await puppeteer.launch({executablePath: chromium, args: ["--no-sandbox", "--disable-gpu"]});
let faults = 0;
const expect = (what, holds) => {
  console.log(`${holds ? "ok   " : "FAULT"} ${what}`);
  if (!holds) ++faults;
};
const pause = ms => new Promise(done => setTimeout(done, ms));

async function visit(name, width, {features = [], scripts = true} = {}) {
  const page = await browser.newPage();
  page.on("pageerror", error => expect(`no script error on ${name}: ${error}`, false));
  page.on("console", said => said.type() === "error" && expect(`no console error on ${name}: ${said.text()}`, false));
  await page.setViewport({width, height: 900});
  await page.setJavaScriptEnabled(scripts);
  await page.emulateMediaFeatures(features.map(([feature, value]) => ({name: feature, value})));
  await page.goto(at(name), {waitUntil: "load"});
  return page;
}
const picture = (page, name) => pictures && page.screenshot({path: join(pictures, name + ".png")});

// Tests the search of the index page.
let page = await visit("index.html", 1280);
await page.click("#find summary");
await page.waitForFunction(() => document.querySelectorAll("#find tbody tr").length > 0);
const found = () => page.$eval("#find [role=status]", e => Number(e.textContent.split(" ")[0]));
const all = await found();
expect("the search knows many checks", all > 100);
await page.type("#find input", "rigid-platform ansys");
const some = await found();
expect("words narrow it", some > 0 && some < all);
const rows = () => page.$$eval("#find tbody tr", all => all.map(e => ({text: e.textContent.toLowerCase(), share: parseFloat(e.lastChild.textContent)})));
expect("all of them are in what is found", (await rows()).every(({text}) => text.includes("rigid-platform") && text.includes("ansys")));
const row = await page.$eval("#find tbody tr", e => e.textContent);
expect("a row says how to run it again", row.includes("./trammel run manipulator-modes --variant rigid-platform"));
const link = await page.$eval("#find tbody a", e => e.href);
await picture(page, "search-1280");
await page.select("#find select[name=verdict]", "passes");
const verdicts = await page.$$eval("#find tbody .verdict", cells => cells.map(e => e.textContent));
expect("the filter by verdict holds", verdicts.length > 0 && verdicts.every(text => text.endsWith("passes")));
await page.$eval("#find input", e => e.value = "");
await page.type("#find input", "circle ");
const shares = (await rows()).map(row => row.share ?? -1);
expect(`the worst come first (${shares.slice(0, 3)})`, shares.length > 20 && shares[0] > shares[20] && shares.every((share, i) => i === 0 || share <= shares[i - 1]));
await page.select("#find select[name=order]", "");
expect("or as they stand", (await rows()).some((row, i, all) => i > 0 && row.share > all[i - 1].share));
for (const [name, value] of [["family", "Elastodynamics"], ["role", "validation"], ["label", "statics"]]) {
  for (const other of ["verdict", "family", "role", "label"]) await page.select(`#find select[name=${other}]`, "");
  const without = await found();
  const there = await page.$$eval(`#find select[name=${name}] option`, (all, value) => all.some(e => e.value === value), value);
  await page.select(`#find select[name=${name}]`, value);
  const left = await found();
  expect(`the filter by ${name} narrows to ${left} of ${without}`, there && left > 0 && left < without);
  if (name === "family") expect("to its cases", (await rows()).every(({text}) => text.includes("run elastodynamics-")));
  if (name === "role") expect("to its checks", (await rows()).every(({text}) => text.includes(", validation")));
}
await page.type("#find input", "no such check");
expect("what is not there is not found", await found() === 0 && (await rows()).length === 0);
await page.goto(link);
expect("its link leads to the check", await page.evaluate(() => document.getElementById(location.hash.slice(1)) !== null));
await page.close();

// Tests the display of values in a figure on hover and by keys.
page = await visit("cases/circle-load.html", 1280);
const drawing = await page.$("figure svg[data-axes]");
await drawing.scrollIntoView();
const box = await drawing.boundingBox();
await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.3 * box.height);
const reading = () => page.$eval("figure .reading:not([hidden])", e => e.textContent).catch(() => "");
const hovered = await reading();
expect(`hover gives values (${hovered})`, /time \(s\) [\d.]+; .*mm.*\d/.test(hovered));
await picture(page, "hover-1280");
await page.mouse.move(0, 0);
expect("and they go again", await reading() === "");
await page.evaluate(() => document.querySelector("figure svg[data-axes]").parentElement.focus());
await page.keyboard.press("ArrowRight");
const first = await reading();
await page.keyboard.press("ArrowRight");
expect("arrow keys read values", first !== "" && await reading() !== first);

// Tests zooming a figure by a dragged frame and by keys, and zooming back.
const view = () => page.$eval("figure svg[data-axes]", e => e.getAttribute("viewBox").split(" ").map(Number));
const whole = await view(), at4 = await reading();
await page.keyboard.press("+");
expect("+ enlarges", (await view())[2] === whole[2] / 2 && await reading() === at4);
await page.keyboard.press("0");
expect("0 shows all again", (await view()).join() === whole.join());
await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.2 * box.height);
await page.mouse.down();
await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.3 * box.height, {steps: 4});
await page.mouse.up();
expect("a frame enlarges what is in it", (await view())[2] < 0.3 * whole[2]);
await picture(page, "zoom-1280");
await page.close();

// Tests the animation of mode shapes.
const shape = page => page.$$eval("svg.moving path[stroke='#1f5fa8']", paths => paths.map(p => p.getAttribute("d")).join());
page = await visit("cases/manipulator-modes.html", 1280);
await page.$eval("svg.moving", e => e.scrollIntoView({block: "center"}));
const frames = [];
for (let i = 0; i < 3; ++i) {
  await pause(300);
  frames.push(await shape(page));
  await picture(page, `mode-${i + 1}`);
}
expect("modes move", new Set(frames).size === 3);
const speed = () => page.$eval(".motion span", e => e.textContent);
const usual = await speed();
await page.focus(".motion input");
await page.keyboard.press("ArrowRight");
expect(`faster by key (${usual}, ${await speed()})`, await speed() !== usual);
await page.click(".motion button");
await pause(200);
const stopped = await shape(page);
await pause(200);
expect("the button stops them", await shape(page) === stopped);
await page.close();
page = await visit("cases/manipulator-modes.html", 1280, {features: [["prefers-reduced-motion", "reduce"]]});
await page.$eval("svg.moving", e => e.scrollIntoView({block: "center"}));
await pause(300);
const still = await shape(page);
await pause(300);
expect("with reduced motion they are still", await shape(page) === still);
await page.close();

// Tests the animation of a motion along its path, with and without the setting for reduced motion.
for (const reduced of [false, true]) {
  page = await visit("cases/elastodynamics-circle.html", 1280, {features: reduced ? [["prefers-reduced-motion", "reduce"]] : []});
  const motion = () => page.$eval("figure[id$=-motion] svg.moving", e => e.querySelector("text").textContent + [...e.querySelectorAll("path")].map(p => p.getAttribute("d")).join());
  await page.$eval("figure[id$=-motion]", e => e.scrollIntoView({block: "center"}));
  const moments = [];
  for (let i = 0; i < 3; ++i) {
    await pause(300);
    moments.push(await motion());
    if (!reduced) await picture(page, `motion-${i + 1}`);
  }
  expect(reduced ? "with reduced motion it is still" : "a motion moves", new Set(moments).size === (reduced ? 1 : 3));
  await page.focus("figure[id$=-motion] input[name=time]");
  await page.keyboard.press("Home");
  const start = await motion();
  await page.keyboard.press("ArrowRight");
  expect("arrow keys move it", start.startsWith("0 s") && /^0\.06\d* s/.test(await motion()));
  const later = await motion();
  await pause(200);
  expect("and it stays there", await motion() === later);
  await page.close();
}

// Tests the page without scripts.
page = await visit("cases/manipulator-modes.html", 1280, {scripts: false});
await picture(page, "no-script");
await page.close();
page = await visit("cases/elastodynamics-circle.html", 1280, {scripts: false});
const outlines = await page.$$eval("figure[id$=-motion] svg path", paths => paths.filter(p => p.getBoundingClientRect().height > 50).length);
expect(`a motion is a picture without scripts (${outlines} outlines)`, outlines > 8);
await (pictures && page.$eval("figure[id$=-motion]", e => e.scrollIntoView({block: "center"})));
await picture(page, "motion-no-script");
await page.close();
for (const name of ["index.html", "cases/manipulator-modes.html"]) {
  const html = readFileSync(join(out, name), "utf8");
  expect(`${name} says all without scripts`, html.includes("<table") && !/<noscript/.test(html));
}

// Tests accessibility with axe-core, and that no page scrolls horizontally.
for (const name of ["index.html", "cases/manipulator-modes.html", "cases/circle-load.html", "cases/elastodynamics-circle.html", "families/manipulator-modes.html", "references.html", "references/manipulator-modes.html"])
  for (const width of [1280, 400])
    for (const scheme of ["light", "dark"]) {
      if (!existsSync(join(out, name))) continue;
      page = await visit(name, width, {features: [["prefers-color-scheme", scheme], ["prefers-reduced-motion", "reduce"]]});
      if (name === "index.html") await page.click("#find summary");
      if (name === "index.html") await page.waitForSelector("#find tbody tr");
      await page.evaluate(axe);
      const {violations} = await page.evaluate(() => axe.run({iframes: false, preload: false}));
      for (const v of violations) console.log(`  ${v.impact}: ${v.id}, ${v.nodes.length} places, as ${v.nodes[0].target}: ${v.help}`);
      const serious = violations.filter(v => ["serious", "critical"].includes(v.impact));
      expect(`axe finds nothing serious on ${name}, ${width}, ${scheme}`, serious.length === 0);
      expect("nothing sticks out", await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      if (scheme === "light") await picture(page, name.replaceAll("/", "-") + "-" + width);
      await page.close();
    }
await browser.close();
process.exit(faults ? 1 : 0);
