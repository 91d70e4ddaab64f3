// Reads AMC files with an independent KTX2 reader and checks what it says of them.
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";
import { decompress } from "fzstd";
import { read, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R16G16B16A16_SFLOAT, KHR_SUPERCOMPRESSION_ZSTD } from "ktx-parse";

for (const file of process.argv.slice(2)) {
    const ktx = read(new Uint8Array(readFileSync(file)));
    const eightBit = ktx.vkFormat === VK_FORMAT_R8G8B8A8_SRGB;
    assert.ok(eightBit || ktx.vkFormat === VK_FORMAT_R16G16B16A16_SFLOAT, "format");
    assert.equal(ktx.typeSize, eightBit ? 1 : 2, "type size");
    assert.ok(ktx.pixelDepth > 0 && ktx.layerCount === 0 && ktx.faceCount === 1, "a 3D texture");
    assert.equal(ktx.supercompressionScheme, KHR_SUPERCOMPRESSION_ZSTD, "supercompression");
    assert.equal(ktx.keyValue.KTXorientation, "ruo", "orientation");
    assert.ok(ktx.keyValue.KTXwriter, "writer");
    const raw = ktx.keyValue.amc;
    const about = JSON.parse(typeof raw === "string" ? raw : Buffer.from(raw).toString("utf8").replace(/\0$/, ""));
    assert.equal(about.version, 1);
    assert.ok([1, 2, 3, 4].includes(about.symmetry));

    const [descriptor] = ktx.dataFormatDescriptor;
    assert.equal(descriptor.colorPrimaries, 1, "Rec. 709 primaries");
    assert.equal(descriptor.transferFunction, eightBit ? 2 : 1, "transfer function");
    assert.equal(descriptor.samples.length, 4, "samples");
    descriptor.samples.forEach((sample, index) => {
        const bits = eightBit ? 8 : 16;
        assert.equal(sample.bitOffset, index * bits, "bit offset");
        assert.equal(sample.bitLength, bits - 1, "bit length");
    });
    assert.equal(descriptor.samples[3].channelType & 0xf, 15, "the fourth sample is alpha");

    const [level] = ktx.levels;
    const bytes = ktx.pixelWidth * ktx.pixelHeight * ktx.pixelDepth * (eightBit ? 4 : 8);
    assert.equal(level.uncompressedByteLength, bytes, "uncompressed length");
    assert.equal(decompress(level.levelData).length, bytes, "the data unpack");
    console.log(`${file}: ${ktx.pixelWidth} x ${ktx.pixelHeight} x ${ktx.pixelDepth}: valid`);
}
