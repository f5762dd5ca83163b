// Makes the one file that pages hold: the modules here and what of three.js they use, minified, compressed, in base64. Its first line is the
// SHA-256 of the files that it was made from, each after its name, so that a test sees without npm whether it is theirs.

import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [, , output] = process.argv;
const names = readdirSync('.').filter((name) => /\.(js|mjs|json)$/.test(name)).sort();
const hash = createHash('sha256');
for (const name of names) hash.update(`${name}\n`).update(readFileSync(name));
const { outputFiles } = await build({
  entryPoints: ['main.js'],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'none',
  charset: 'utf8',
  write: false,
});
const packed = gzipSync(outputFiles[0].contents, { level: 9 });
// The operating system that packed it is no part of it.
packed[9] = 255;
const lines = packed.toString('base64').match(/.{1,160}/g);
writeFileSync(output, `${hash.digest('hex')}\n${lines.join('\n')}\n`);
console.log(`${output}: ${packed.length} bytes of ${outputFiles[0].contents.length}`);
