// Checks GLB files by Khronos' validator: no errors, no warnings. Everything else that it says is printed.
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";
import validator from "gltf-validator";

for (const file of process.argv.slice(2)) {
    const bytes = new Uint8Array(readFileSync(file));
    const report = await validator.validateBytes(bytes, { uri: file, maxIssues: 0 });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    const counts = new Map();
    for (const { code, message, pointer, severity } of messages) {
        if (severity < 2) {
            console.error(`${file}: ${pointer}: ${code}: ${message}`);
        }
        counts.set(code, (counts.get(code) ?? 0) + 1);
    }
    assert.equal(numErrors + numWarnings, 0, `${file}: ${numErrors} errors, ${numWarnings} warnings`);
    const told = [...counts].map(([code, count]) => `${count} x ${code}`).join(", ");
    console.log(`${file}: valid (${numInfos} infos, ${numHints} hints${told ? `: ${told}` : ""})`);
}
