// The viewer's decoder in Node, on a page that the program wrote: poses are those of the run's trajectory within what the page tells.
// SCREE_PROGRAM=FILE node --test tests/viewer/decoder_test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';

const program = process.env.SCREE_PROGRAM ?? 'build/release/demos/scree';
const { RecordedSource } = await import('../../demos/viewer/source.js');

// The page's elements, as a browser has them.
function elementsOf(page) {
  return Array.from(page.matchAll(/<script type="application\/x-scree"([^>]*)>([^<]*)<\/script>/g), ([, attributes, textContent]) => (
    { textContent, dataset: Object.fromEntries(Array.from(attributes.matchAll(/data-(\w+)="([^"]*)"/g), ([, name, value]) => [name, value])) }));
}

for (const [scene, seconds] of [['pile --bodies 150', 3], ['bridge', 2], ['cars', 2], ['glass', 2]]) {
  test(`${scene}: poses are within what the page tells, from any frame on`, async () => {
    const place = mkdtempSync(join(tmpdir(), 'scree-decoder-'));
    try {
      execFileSync(program, ['run', ...scene.split(' '), '--seconds', String(seconds), '--backend', 'cpu', '--quiet',
        '--html', join(place, 'run.html'), '--trajectory', join(place, 'run.csv'), '--trajectory-every', '2']);
      const source = new RecordedSource(elementsOf(readFileSync(join(place, 'run.html'), 'utf8')));
      await source.open();
      const [names, ...lines] = readFileSync(join(place, 'run.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
      const column = (name) => {
        const at = names.indexOf(name);
        assert.ok(at >= 0, `${name} in ${names}`);
        return at;
      };
      const [time, body, exists] = ['time', 'body', 'exists'].map(column);
      const position = ['x', 'y', 'z'].map(column), orientation = ['qx', 'qy', 'qz', 'qw'].map(column), velocity = ['vx', 'vy', 'vz'].map(column);
      const moments = new Map();
      for (const line of lines) {
        const frame = Math.round(Number(line[time]) / source.seconds);
        if (!moments.has(frame)) moments.set(frame, []);
        moments.get(frame).push(line);
      }
      assert.ok(source.count >= 30 * seconds);
      const { errors, units } = source.scene.head, places = new Map(source.scene.bodies.map(({ id }, place) => [id, place]));
      let worst = 0, worstTurn = 0, seen = 0;
      const check = (moment) => {
        for (const line of moments.get(moment.index) ?? []) {
          const i = places.get(Number(line[body]));
          if (i === undefined || i >= moment.count) continue;
          const there = line[exists] === '1' || line[exists] === 'true';
          assert.equal(moment.exists[i] === 1, there, `body ${line[body]} at frame ${moment.index}`);
          if (!there) continue;
          ++seen;
          for (let k = 0; k < 3; ++k) {
            worst = Math.max(worst, Math.abs(moment.position[3 * i + k] * units.position - Number(line[position[k]])) / errors.position);
            worst = Math.max(worst, Math.abs(moment.velocity[3 * i + k] * units.velocity - Number(line[velocity[k]])) / errors.velocity);
          }
          const q = orientation.map((at) => Number(line[at])), own = Array.from(moment.orientation.subarray(4 * i, 4 * i + 4));
          const sign = q.reduce((sum, x, k) => sum + x * own[k], 0) < 0 ? -1 : 1;
          worstTurn = Math.max(worstTurn, 4 * Math.asin(Math.min(1, Math.hypot(...q.map((x, k) => sign * x - own[k])) / 2)) / errors.angle);
        }
      };
      const touching = [];
      const sumOf = ({ contacts }) => contacts && [contacts.count, ...contacts.a, ...contacts.b, ...contacts.point, ...contacts.level].join();
      await source.scan((moment) => {
        check(moment);
        touching[moment.index] = sumOf(moment);
        for (let i = 0; i < (moment.contacts?.count ?? 0); ++i) {  // beside its bodies
          const body = source.scene.bodies[moment.contacts.a[i]].plane ? moment.contacts.b[i] : moment.contacts.a[i];
          const [x, y, z] = [0, 1, 2].map((k) => moment.contacts.point[3 * i + k] - moment.position[3 * body + k] * units.position);
          assert.ok(Math.hypot(x, y, z) < 60, `a contact ${[x, y, z]} m beside body ${body}`);
        }
      }, () => false);
      assert.ok(seen > 1000, `${seen} poses`);
      assert.ok(worst < 1.02 && worstTurn < 1.02, `${worst} and ${worstTurn} of what is told`);
      assert.ok(worst > 0.5);
      // Back and forth, as by a slider.
      for (const frame of [40, 3, 44, 45, 46, 20, source.count - 2, 0]) {
        if (!source.show(frame)) {
          await new Promise((resolve) => (source.onReady = resolve));
          assert.ok(source.show(frame));
        }
        assert.equal(source.now.index, Math.min(frame + 1, source.count - 1));
        check(source.now);
        assert.equal(sumOf(source.now), touching[source.now.index]);
      }
      assert.ok(worst < 1.02 && worstTurn < 1.02);
    } finally {
      rmSync(place, { recursive: true });
    }
  });
}
