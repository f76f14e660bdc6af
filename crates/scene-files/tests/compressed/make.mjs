// Makes the scenes of this folder: one of everything that exporters compress, and its compressed twins. The files are
// kept with the tests, so that they need neither Node.js nor the network; README.md has the versions that made them.
//
//   npm install @gltf-transform/core @gltf-transform/extensions @gltf-transform/cli gltfpack ktx2-encoder sharp
//   node make.mjs
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { Document, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS, EXTMeshGPUInstancing } from "@gltf-transform/extensions";
import { ktx2 } from "ktx2-encoder/gltf-transform";
import sharp from "sharp";

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
const document = new Document();
const buffer = document.createBuffer();
const accessor = (type, array, normalized = false) =>
  document.createAccessor().setType(type).setArray(array).setNormalized(normalized).setBuffer(buffer);

// A sphere with a seam: rings of columns + 1 vertices, pulled out of round so that no two are alike.
const [columns, rings] = [12, 6];
const rows = { position: [], normal: [], tangent: [], uv: [], uv1: [], color: [], joint: [], weight: [], push: [], bend: [] };
for (let ring = 0; ring <= rings; ring++) {
  for (let column = 0; column <= columns; column++) {
    const [u, v] = [column / columns, ring / rings];
    const [phi, theta] = [2 * Math.PI * u, Math.PI * v];
    const out = [Math.cos(phi) * Math.sin(theta), Math.cos(theta), Math.sin(phi) * Math.sin(theta)];
    const radius = 1 + 0.2 * Math.sin(3 * phi) * Math.sin(theta);
    rows.position.push(out[0] * radius, out[1] * 1.5, out[2] * radius);
    rows.normal.push(...out);
    rows.tangent.push(-Math.sin(phi), 0, Math.cos(phi), column % 2 ? 1 : -1);
    rows.uv.push(3 * u - 0.5, 2 * v);
    rows.uv1.push(v, u);
    rows.color.push(Math.round(255 * u), Math.round(255 * v), Math.round(255 * (1 - u)), 255);
    rows.joint.push(0, 1, 0, 0);
    rows.weight.push(v, 1 - v, 0, 0);
    rows.push.push(0.3 * out[0], 0.1 * v, 0.3 * out[2]);
    rows.bend.push(0, 0.2 * Math.sin(phi), 0);
  }
}
const corners = [];
for (let ring = 0; ring < rings; ring++) {
  for (let column = 0; column < columns; column++) {
    const [a, b] = [ring * (columns + 1) + column, (ring + 1) * (columns + 1) + column];
    if (ring > 0) corners.push(a, a + 1, b);
    if (ring < rings - 1) corners.push(a + 1, b + 1, b);
  }
}
const [positions, normals] = [new Float32Array(rows.position), new Float32Array(rows.normal)];

const texels = Buffer.alloc(36 * 20 * 4);
for (let i = 0; i < 36 * 20; i++) {
  const [x, y] = [i % 36, Math.floor(i / 36)];
  texels.set([7 * x, 12 * y, (x >> 2) % 2 === (y >> 2) % 2 ? 220 : 60, x < 18 ? 255 : 128], 4 * i);
}
const png = await sharp(texels, { raw: { width: 36, height: 20, channels: 4 } }).png().toBuffer();
const texture = document.createTexture("pattern").setImage(png).setMimeType("image/png");
const shiny = document.createMaterial("shiny").setBaseColorTexture(texture).setMetallicFactor(0).setAlphaMode("BLEND");
shiny.getBaseColorTextureInfo().setTexCoord(0);
const green = document.createMaterial("green").setBaseColorFactor([0.4, 0.6, 0.3, 1]);
const plain = document.createMaterial("plain").setBaseColorFactor([0.6, 0.5, 0.4, 1]).setEmissiveTexture(texture)
  .setEmissiveFactor([0.2, 0.2, 0.2]);
plain.getEmissiveTextureInfo().setTexCoord(1);

// A mesh with joints and a morph target, both moved by a clip.
const target = document.createPrimitiveTarget("push")
  .setAttribute("POSITION", accessor("VEC3", new Float32Array(rows.push)))
  .setAttribute("NORMAL", accessor("VEC3", new Float32Array(rows.bend)));
const skinned = document.createPrimitive().setMaterial(shiny)
  .setIndices(accessor("SCALAR", new Uint16Array(corners)))
  .setAttribute("POSITION", accessor("VEC3", positions))
  .setAttribute("NORMAL", accessor("VEC3", normals))
  .setAttribute("TANGENT", accessor("VEC4", new Float32Array(rows.tangent)))
  .setAttribute("TEXCOORD_0", accessor("VEC2", new Float32Array(rows.uv)))
  .setAttribute("COLOR_0", accessor("VEC4", new Uint8Array(rows.color), true))
  .setAttribute("JOINTS_0", accessor("VEC4", new Uint8Array(rows.joint)))
  .setAttribute("WEIGHTS_0", accessor("VEC4", new Float32Array(rows.weight)))
  .addTarget(target);
const joints = [document.createNode("root"), document.createNode("tip").setTranslation([0, 0.5, 0])];
joints[0].addChild(joints[1]);
const inverse = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const skin = document.createSkin().addJoint(joints[0]).addJoint(joints[1])
  .setInverseBindMatrices(accessor("MAT4", new Float32Array([...inverse, ...inverse])));
const body = document.createNode("body").setSkin(skin)
  .setMesh(document.createMesh("body").addPrimitive(skinned).setWeights([0.25]));

// A still one, placed by a node, with the second set of texture coordinates.
const still = document.createPrimitive().setMaterial(plain)
  .setIndices(accessor("SCALAR", new Uint16Array(corners)))
  .setAttribute("POSITION", accessor("VEC3", positions))
  .setAttribute("NORMAL", accessor("VEC3", normals))
  .setAttribute("TEXCOORD_0", accessor("VEC2", new Float32Array(rows.uv)))
  .setAttribute("TEXCOORD_1", accessor("VEC2", new Float32Array(rows.uv1)));
const rock = document.createNode("rock").setMesh(document.createMesh("rock").addPrimitive(still))
  .setTranslation([4, 0.3, -1]).setRotation([0, Math.sin(0.4), 0, Math.cos(0.4)]).setScale([1.5, 0.7, 1]);

// A strip, and copies of it.
const leaf = document.createPrimitive().setMode(5)
  .setIndices(accessor("SCALAR", new Uint16Array([0, 1, 2, 3, 4, 5])))
  .setAttribute("POSITION", accessor("VEC3", new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0.1, 1, 1, 0.2, 0, 2, 0, 1, 2, 0])))
  .setMaterial(green);
const places = Array.from({ length: 7 }, (_, i) => i);
const copies = document.createExtension(EXTMeshGPUInstancing).setRequired(true).createInstancedMesh()
  .setAttribute("TRANSLATION", accessor("VEC3", new Float32Array(places.flatMap((i) => [-4 + 0.1 * i * i, -2, i]))))
  .setAttribute("ROTATION", accessor("VEC4", new Float32Array(
    places.flatMap((i) => [0, 0, Math.sin(0.2 * i), Math.cos(0.2 * i)]))))
  .setAttribute("SCALE", accessor("VEC3", new Float32Array(places.flatMap((i) => [1, 1 + 0.25 * i, 1]))));
const leaves = document.createNode("leaves").setMesh(document.createMesh("leaf").addPrimitive(leaf))
  .setExtension("EXT_mesh_gpu_instancing", copies);

const times = accessor("SCALAR", new Float32Array([0, 0.5, 1, 1.5, 2]));
const clip = document.createAnimation("bend");
const move = (node, path, type, array) => {
  const sampler = document.createAnimationSampler().setInput(times).setOutput(accessor(type, new Float32Array(array)));
  clip.addSampler(sampler)
    .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(sampler));
};
const turn = [0, 0.3, 0.7, 0.2, -0.4].map((angle) => angle / 2);
move(joints[1], "rotation", "VEC4", turn.flatMap((half) => [0, 0, Math.sin(half), Math.cos(half)]));
move(joints[0], "translation", "VEC3", [0, 0, 0, 0.1, 0.5, 0, 0.3, 0.25, 0, 0.2, 0.1, 0.7, 0, 0, 0]);
move(joints[0], "scale", "VEC3", [1, 1, 1, 1.2, 1, 1, 1.3, 1.1, 1, 1, 1, 1.4, 1, 1, 1]);
move(body, "weights", "SCALAR", [0.25, 0.5, 1, 0.75, 0]);

const scene = document.createScene();
[joints[0], body, rock, leaves].forEach((node) => scene.addChild(node));
await io.write("plain.glb", document);

const run = (program, ...rest) => execFileSync("npx", [program, ...rest], { stdio: "inherit" });
run("gltf-transform", "meshopt", "plain.glb", "gltf-transform-high.glb");
run("gltf-transform", "meshopt", "--level", "medium", "plain.glb", "gltf-transform-medium.glb");
run("gltf-transform", "draco", "plain.glb", "draco-edgebreaker.glb");
run("gltf-transform", "draco", "--encode-speed", "0", "--decode-speed", "0", "plain.glb", "draco-valence.glb");
run("gltf-transform", "draco", "--method", "sequential", "plain.glb", "draco-sequential.glb");
// -af 0: the times of keys are those of the file.
const pack = (output, ...options) => run("gltfpack", "-i", "plain.glb", "-o", output, "-kn", "-km", "-kv", "-af", "0", ...options);
pack("gltfpack-quantized.glb");
pack("gltfpack-c.glb", "-c");
pack("gltfpack-cc.glb", "-cc");
pack("gltfpack-khr.glb", "-cc", "-ce", "khr", "-vpn", "-vn", "16", "-vc", "16");
pack("gltfpack-floats.glb", "-cc", "-ce", "khr", "-vpf", "-vtf", "-vnf");
pack("gltfpack-fallback.gltf", "-cf");

// Textures of each kind, and what the transcoder of Basis Universal makes of them.
const library = "./node_modules/ktx2-encoder/dist/basis/basis_encoder";
const basis = await (await import(`${library}.js`)).default({ wasmBinary: readFileSync(`${library}.wasm`) });
basis.initializeBasis();
const RGBA32 = 13;
const transcoded = (bytes) => {
  const file = new basis.KTX2File(new Uint8Array(bytes));
  file.startTranscoding();
  const data = new Uint8Array(file.getImageTranscodedSizeInBytes(0, 0, 0, RGBA32));
  file.transcodeImage(data, 0, 0, 0, RGBA32, 0, -1, -1);
  return sharp(data, { raw: { width: file.getWidth(), height: file.getHeight(), channels: 4 } }).png();
};
const imageDecoder = async (bytes) => {
  const { data, info } = await sharp(bytes).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return { data: new Uint8Array(data), width: info.width, height: info.height };
};
for (const [name, options] of [
  ["etc1s", { isUASTC: false, qualityLevel: 255, compressionLevel: 2 }],
  ["uastc", { isUASTC: true, needSupercompression: false }],
  ["uastc-zstd", { isUASTC: true, needSupercompression: true }],
]) {
  const copy = await io.read("plain.glb");
  await copy.transform(ktx2({ generateMipmap: true, isKTX2File: true, imageDecoder, ...options }));
  await io.write(`ktx2-${name}.glb`, copy);
  if (name !== "uastc-zstd") await transcoded(copy.getRoot().listTextures()[0].getImage()).toFile(`ktx2-${name}.png`);
}
