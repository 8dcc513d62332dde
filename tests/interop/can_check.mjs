// Every signal of every frame in a log, read by a DBC library that is not ours, against what
// `dottrack monitor --json --signals` says.
//
//   node can_check.mjs DOTTRACK CAN.LOG [--base-id N] [--extended] [--poses POSES.CSV]
//
// The layout is the one that `DOTTRACK dbc` prints for these identifiers. Raw values must be equal bit
// for bit, and with them what the value tables call them; so must physical values, but for the
// rounding of printed numbers. With --poses also against what the tracker found.
//
// candied 2.2.0 has limits, which this works around:
// - it reads one digit of a message's length, so that 64 bytes become 6: the length comes from the file;
// - it keeps the bit of the file that marks an identifier of 29 bits as part of the identifier;
// - it cuts physical values off at the signal's limits, so what is beyond them ("not available") is
//   compared by its raw value alone;
// - it looks names up by the physical value instead of the raw one: here they are looked up by the raw.
// Exit status: 0 all agree, 1 something differs, 2 wrong use.

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import candied from 'candied';
import { compareWithPoses, groupsOf, posesOf } from './poses_check.mjs';

const EXTENDED = 0x80000000; // of an identifier in a DBC file
const NOT_AVAILABLE = 'not available';
const PRINTED = 1e-14; // relative: monitor prints fifteen digits
const FEWEST_FRAMES = 1000;
const FEWEST_SIGNALS = 5000;
const FEWEST_POSES = 100;

class Mismatch extends Error {}

function expect(condition, what) {
  if (!condition) throw new Mismatch(what);
}

const run = (program, args) => execFileSync(program, args, { encoding: 'utf8', maxBuffer: 2 ** 30 });

// --- candump's log ---

const LINE = /^\(([0-9.]+)\) (\S+) ([0-9A-F]{3}|[0-9A-F]{8})#(#[0-9A-F])?([0-9A-F]*)$/;

function frameOf(line) {
  const match = LINE.exec(line);
  expect(match, `no line of candump -L: "${line}"`);
  const [, time, , id, fd, data] = match;
  const payload = data.match(/../g)?.map((byte) => parseInt(byte, 16)) ?? [];
  return { time, id: parseInt(id, 16), isExtended: id.length === 8, fd: fd !== undefined, payload, dlc: payload.length };
}

const framesOf = (log) => readFileSync(log, 'utf8').split('\n').filter(Boolean).map(frameOf);

// --- candied ---

function readerOf(dbc) {
  const data = new candied.Dbc().load(dbc);
  const lengths = [...dbc.matchAll(/^BO_ (\d+) \w+ *: *(\d+)/gm)];
  expect(lengths.length === data.messages.size, `${data.messages.size} of ${lengths.length} messages`);
  const byId = new Map([...data.messages.values()].map((message) => [message.id, message]));
  for (const [, id, length] of lengths) byId.get(Number(id)).dlc = Number(length);
  const signals = [...dbc.matchAll(/^ SG_ /gm)].length;
  const known = [...byId.values()].reduce((sum, message) => sum + message.signals.size, 0);
  expect(known === signals, `${known} of ${signals} signals`);
  const can = new candied.Can();
  can.database = data;
  return (frame) => {
    const message = can.decode({ ...frame, id: frame.id + (frame.isExtended ? EXTENDED : 0) });
    return message && { ...message, frame };
  };
}

// --- the comparison ---

function compareSignal(name, bound, physical) {
  const { signal } = bound.boundData;
  const word = signal.valueTable?.get(bound.rawValue);
  if (word === NOT_AVAILABLE || physical === null) {
    expect(word === NOT_AVAILABLE && physical === null, `${name}: ${word ?? bound.rawValue} here, ${physical} there`);
    return;
  }
  const raw = Math.round((physical - signal.offset) / signal.factor);
  expect(raw === bound.rawValue, `${name}: raw ${bound.rawValue} here, ${raw} (${physical}) there`);
  const expected = bound.rawValue * signal.factor + signal.offset;
  expect(Math.abs(physical - expected) <= PRINTED * Math.abs(expected), `${name}: ${expected} here, ${physical} there`);
  const within = expected >= signal.min && expected <= signal.max;
  expect(!within || Math.abs(bound.value - expected) <= PRINTED * Math.abs(expected), `${name}: ${bound.value}, ${expected}`);
}

function compareFrame(message, line) {
  const where = `${message.frame.time} ${message.name}`;
  expect(line.message === message.name && line.id === message.frame.id, `${where} here, ${line.message} there`);
  const theirs = [...message.boundSignals.keys()].sort();
  expect(theirs.join() === Object.keys(line.signals).sort().join(), `${where}: other signals`);
  for (const [name, bound] of message.boundSignals) compareSignal(`${where} ${name}`, bound, line.signals[name]);
  return theirs.length;
}

function compare(messages, lines) {
  expect(messages.length === lines.length, `${messages.length} frames here, ${lines.length} there`);
  expect(messages.length >= FEWEST_FRAMES, `${messages.length} frames; expected at least ${FEWEST_FRAMES}`);
  const compared = messages.map((message, i) => compareFrame(message, lines[i]));
  const kinds = new Set(messages.map((message) => message.name)).size;
  const signals = compared.reduce((sum, count) => sum + count, 0);
  expect(signals >= FEWEST_SIGNALS, `${signals} signals; expected at least ${FEWEST_SIGNALS}`);
  return `${messages.length} frames of ${kinds} messages, ${signals} signals`;
}

function compareTracker(messages, csv) {
  const { difference, groups, valid } = compareWithPoses(groupsOf(messages), posesOf(csv));
  expect(difference === undefined, difference);
  expect(valid >= FEWEST_POSES, `${valid} poses; expected at least ${FEWEST_POSES}`);
  return `, ${groups} groups as the tracker has them, ${valid} with a pose`;
}

function addressingArgs(values) {
  return [...(values['base-id'] ? ['--base-id', values['base-id']] : []), ...(values.extended ? ['--extended'] : [])];
}

function check(dottrack, log, values) {
  const addressing = addressingArgs(values);
  const decode = readerOf(run(dottrack, ['dbc', ...addressing]));
  const messages = framesOf(log).map(decode).filter(Boolean);
  const monitored = run(dottrack, ['monitor', '--log', log, '--json', '--signals', '--age-limit', '5', ...addressing]);
  const lines = monitored.split('\n').filter(Boolean).map((line) => JSON.parse(line));
  const found = compare(messages, lines.filter((line) => 'signals' in line));
  return found + (values.poses ? compareTracker(messages, readFileSync(values.poses, 'utf8')) : '');
}

function main() {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { 'base-id': { type: 'string' }, extended: { type: 'boolean' }, poses: { type: 'string' } },
  });
  const [dottrack, log] = positionals;
  if (!dottrack || !log) {
    console.error('usage: node can_check.mjs DOTTRACK CAN.LOG [--base-id N] [--extended] [--poses POSES.CSV]');
    return 2;
  }
  try {
    console.log(`candied: ${check(dottrack, log, values)}: all agree`);
    return 0;
  } catch (error) {
    console.error(`candied: ${error instanceof Mismatch ? error.message : error.stack}`);
    return 1;
  }
}

process.exitCode = main();
