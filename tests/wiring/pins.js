// The pins of all elements of @wokwi/elements, as JSON: each class is made without a browser, its drawing left out.
// Usage: node pins.js FOLDER-OF-THE-PACKAGE
const Module = require("module");
const path = require("path");

const elements = {};
const nothing = () => "";
const decorator = () => () => {};
const lit = { LitElement: class {}, css: nothing, html: nothing, svg: nothing };
const decorators = {
  customElement: (name) => (element) => { elements[name] = element; return element; },
  property: decorator, query: decorator, state: decorator,
};
const load = Module._load;
Module._load = function (request, ...rest) {
  if (request === "lit") return lit;
  if (request === "lit/decorators.js") return decorators;
  if (request.startsWith("lit/")) return new Proxy({}, { get: () => nothing });
  return load.call(this, request, ...rest);
};
globalThis.ImageData = class {};
require(path.join(path.resolve(process.argv[2]), "dist", "cjs", "index.js"));
const pins = {};
for (const [name, element] of Object.entries(elements)) {
  pins[name] = (new element().pinInfo || []).map((pin) => pin.name);
}
console.log(JSON.stringify(pins));
