// A log of ours read by can-utils: log2asc turns it into Vector's ASC format, asc2log turns that back.
//
//   node can_utils_check.mjs CAN.LOG OUT.ASC
//
// Every frame must be in the ASC file with its identifier, kind and bytes, as read from ASC's columns
// here; and what comes back must be the log that went in, line by line but for the time, which ASC
// counts from the first frame on. log2asc takes the second 0 for "no frame yet", so a simulated log,
// which begins there, is moved into this century first.
// Exit status: 0 all agree, 1 something differs, 2 wrong use.

import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';

const FEWEST = 1000;
const CENTURY = 1_000_000_000; // seconds

class Mismatch extends Error {}

function expect(condition, what) {
  if (!condition) throw new Mismatch(what);
}

// Standard error: words about locale and date, unless it fails.
const run = (program, args) => execFileSync(program, args, { stdio: ['ignore', 'pipe', 'pipe'] });

const LINE = /^\(([0-9.]+)\) (\S+) (([0-9A-F]+)#(#?)([0-9A-F]*))(?: [RT])?$/; // asc2log adds the direction

function lineOf(text) {
  const match = LINE.exec(text);
  expect(match, `no line of candump -L: "${text}"`);
  const [, time, device, frame, id, fd, data] = match;
  return { time: Number(time), device, frame, id: parseInt(id, 16), extended: id.length === 8, fd: fd !== '', data: fd ? data.slice(1) : data };
}

const linesOf = (text) => text.split('\n').filter(Boolean).map(lineOf);

// `0.010000 1  300x  Rx  d 8 00 11 ...` and
// `0.010000 CANFD  1 Rx  300x  1 0 f 64 00 11 ...`: the identifier, its x, the length, the bytes.
const CLASSIC = /^ *[0-9.]+ +\d+ +([0-9A-F]+)(x?) +Rx +d +(\d+)((?: [0-9A-F]{2})*)/;
const FD = /^ *[0-9.]+ +CANFD +\d+ +Rx +([0-9A-F]+)(x?) +[01] [01] [0-9a-f] +(\d+)((?: [0-9A-F]{2})*)/;

function checkAsc(asc, lines) {
  const events = asc.split(/\r?\n/).filter((line) => /^ *[0-9]+\.[0-9]+ /.test(line) && / Rx /.test(line));
  expect(events.length === lines.length, `${events.length} of ${lines.length} frames in the ASC file`);
  lines.forEach((line, i) => {
    const match = (line.fd ? FD : CLASSIC).exec(events[i]);
    expect(match, `frame ${line.frame} became "${events[i]}"`);
    const [, id, x, length, bytes] = match;
    const data = bytes.replaceAll(' ', '').slice(0, 2 * Number(length));
    const same = parseInt(id, 16) === line.id && (x === 'x') === line.extended && data === line.data;
    expect(same && Number(length) === line.data.length / 2, `frame ${line.frame} became "${events[i]}"`);
  });
}

function checkBack(back, lines) {
  expect(back.length === lines.length, `${back.length} of ${lines.length} frames come back`);
  lines.forEach((line, i) => {
    expect(back[i].frame === line.frame, `frame ${line.frame} comes back as ${back[i].frame}`);
    const later = back[i].time - back[0].time - (line.time - lines[0].time);
    expect(Math.abs(later) < 2e-6, `frame ${i} comes back ${later} s later`);
  });
}

function check(log, asc) {
  const text = readFileSync(log, 'utf8').replaceAll(/^\((\d+)/gm, (_, s) => `(${CENTURY + Number(s)}`);
  const lines = linesOf(text);
  expect(lines.length >= FEWEST, `${lines.length} frames; expected at least ${FEWEST}`);
  writeFileSync(`${asc}.in`, text);
  run('log2asc', ['-I', `${asc}.in`, '-O', asc, lines[0].device]);
  checkAsc(readFileSync(asc, 'utf8'), lines);
  run('asc2log', ['-I', asc, '-O', `${asc}.log`]);
  checkBack(linesOf(readFileSync(`${asc}.log`, 'utf8')), lines);
  return lines;
}

function main([log, asc]) {
  if (!log || !asc) {
    console.error('usage: node can_utils_check.mjs CAN.LOG OUT.ASC');
    return 2;
  }
  try {
    const lines = check(log, asc);
    const of = (key) => lines.filter((line) => line[key]).length;
    console.log(`can-utils: ${lines.length} frames, ${of('fd')} of them FD, ${of('extended')} with 29 bits: all agree`);
    return 0;
  } catch (error) {
    console.error(`can-utils: ${error instanceof Mismatch ? error.message : error.stack}`);
    return 1;
  }
}

process.exitCode = main(process.argv.slice(2));
