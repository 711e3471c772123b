// Runs Khronos's validator on a binary glTF: `node validate_gltf.js <folder with node_modules> <file.glb>`. Status 1
// where it finds an error or a warning.
const fs = require("fs");
const path = require("path");
const [folder, file] = process.argv.slice(2);
const validator = require(path.join(path.resolve(folder), "node_modules", "gltf-validator"));
validator.validateBytes(new Uint8Array(fs.readFileSync(file))).then((report) => {
    const { numErrors, numWarnings, messages } = report.issues;
    const { totalVertexCount, totalTriangleCount } = report.info;
    console.log(`gltf-validator: ${numErrors} errors, ${numWarnings} warnings, ${totalVertexCount} vertices, ` +
                `${totalTriangleCount} triangles`);
    messages.slice(0, 10).forEach((message) => console.error(message.code, message.pointer, message.message));
    process.exitCode = numErrors + numWarnings > 0 ? 1 : 0;
});
