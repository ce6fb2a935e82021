#!/usr/bin/env node
// The program scree in Node: scree run wall --steps 600 --report -. It has no window, no pictures and one processor, the CPU.
import { load } from '../lib/index.js';

const threads = Number(process.env.SCREE_THREADS ?? 1);
const write = (stream) => (line) => stream.write(`${line}\n`);
const scree = await load({ threads, print: write(process.stdout), printError: write(process.stderr) });
// Files are those of the folder where it is called, and below.
scree.files.mkdir('/here');
scree.files.mount(scree.files.filesystems.NODEFS, { root: process.cwd() }, '/here');
scree.files.chdir('/here');
process.exitCode = scree.command(process.argv.slice(2));
