// Messages of Khronos' validator on a glTF file, one a line: node validate.cjs MODULES FILE
const [, , modules, file] = process.argv;
const validator = require(require("path").join(modules, "gltf-validator"));
validator.validateBytes(new Uint8Array(require("fs").readFileSync(file))).then((report) => {
  for (const m of report.issues.messages) console.log(`${["error", "warning", "information", "hint"][m.severity]} ${m.code} ${m.pointer}: ${m.message}`);
}).catch((e) => { console.error(String(e)); process.exit(1); });
