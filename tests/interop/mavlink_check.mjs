// What `dottrack monitor --mavlink` sends, read by a MAVLink library that is not ours and compared
// with the poses that `--json` prints beside it.
//
//   node mavlink_check.mjs DOTTRACK CAN.LOG
//
// runs DOTTRACK monitor --log CAN.LOG --json --mavlink 127.0.0.1:PORT on a port of its own. Checksums
// and fields are the library's business; frames, covariance, time and counters are computed here from
// the JSON, with rotation matrices where dottrack has quaternions. Datagrams may get lost even on one
// machine: what arrives must be right, and at least half of it must arrive.
// Exit status: 0 all agree, 1 something differs, 2 wrong use.

import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { pathToFileURL } from 'node:url';
import { MavLinkPacketParser, MavLinkPacketSplitter, common, minimal } from 'node-mavlink';

const MIN_POSES = 20;
const FLOAT = 2 ** -23; // relative rounding of a 32-bit float, doubled
const JSON_DIGITS = 1e-8; // of numbers of ordinary size, as printed

function expect(condition, what) {
  if (!condition) throw new Error(what);
}

function expectNear(found, expected, what, absolute = JSON_DIGITS) {
  const tolerance = absolute + 2 * FLOAT * Math.abs(expected);
  expect(Math.abs(found - expected) <= tolerance, `${what}: ${found} instead of ${expected}`);
}

function expectAllNear(found, expected, what, absolute) {
  expect(found.length === expected.length, `${what}: ${found.length} values`);
  expected.forEach((value, i) => expectNear(found[i], value, `${what}[${i}]`, absolute));
}

// --- frames: 3x3 matrices as rows ---

const NED_ENU = [[0, 1, 0], [1, 0, 0], [0, 0, -1]];
const FLU_FRD = [[1, 0, 0], [0, -1, 0], [0, 0, -1]];

const multiply = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
const transpose = (a) => a[0].map((_, j) => a.map((row) => row[j]));
const apply = (a, v) => a.map((row) => row.reduce((sum, x, k) => sum + x * v[k], 0));

function rotation([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

function fromEuler(roll, pitch, yaw) {
  const [cr, sr, cp, sp, cy, sy] = [roll, pitch, yaw].flatMap((a) => [Math.cos(a), Math.sin(a)]);
  return multiply(
    [[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]],
    multiply([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]], [[1, 0, 0], [0, cr, -sr], [0, sr, cr]]),
  );
}

function nedCovariance(enu) {
  const jacobian = Array.from({ length: 6 }, (_, i) =>
    Array.from({ length: 6 }, (_, j) => (Math.floor(i / 3) === Math.floor(j / 3) ? NED_ENU[i % 3][j % 3] : 0)));
  const rows = Array.from({ length: 6 }, (_, i) => enu.slice(6 * i, 6 * i + 6));
  return multiply(multiply(jacobian, rows), transpose(jacobian));
}

// --- one message against one pose ---

const worldAttitude = (pose) => rotation(pose.quaternion_wxyz);
const nedAttitude = (pose) => multiply(multiply(NED_ENU, worldAttitude(pose)), FLU_FRD);
const microseconds = (seconds) => Math.round(1e6 * seconds);
// Ages are rounded up, so the first exposure of a simulation seems to be before its clock began.
const exposureUs = (pose) => BigInt(Math.max(0, microseconds(pose.arrival_s) - microseconds(pose.age_s)));

function checkCovariance(found, pose, what) {
  if (!pose.covariance) return expect(Number.isNaN(found[0]), `${what}: known, where the pose has none`);
  const matrix = nedCovariance(pose.covariance);
  const upper = matrix.flatMap((row, i) => row.slice(i));
  expectAllNear(found, upper, what, 1e-9 * Math.max(...upper.map(Math.abs)));
}

function checkIfKnown(found, expected, what) {
  if (expected) return expectAllNear(found, expected, what, 1e-7);
  expect(found.every(Number.isNaN), `${what}: known, where the pose has none`);
}

function checkPosition(message, pose) {
  expectAllNear([message.x, message.y, message.z], apply(NED_ENU, pose.position_m), 'position');
}

function checkVision(message, pose) {
  checkPosition(message, pose);
  const found = fromEuler(message.roll, message.pitch, message.yaw);
  expectAllNear(found.flat(), nedAttitude(pose).flat(), 'roll, pitch, yaw', 5e-6);
  checkCovariance(message.covariance, pose, 'covariance');
}

function checkOdometry(message, pose) {
  checkPosition(message, pose);
  expectAllNear(rotation(message.q).flat(), nedAttitude(pose).flat(), 'q', 1e-6);
  const forward = pose.velocity_m_s && apply(transpose(worldAttitude(pose)), pose.velocity_m_s);
  checkIfKnown([message.vx, message.vy, message.vz], forward && apply(FLU_FRD, forward), 'velocity');
  const rates = [message.rollspeed, message.pitchspeed, message.yawspeed];
  checkIfKnown(rates, pose.rates_rad_s && apply(FLU_FRD, pose.rates_rad_s), 'rates');
  checkCovariance(message.poseCovariance, pose, 'pose_covariance');
  expect(Number.isNaN(message.velocityCovariance[0]), 'velocity_covariance: known');
  expect(message.frameId === common.MavFrame.LOCAL_FRD, `frame_id ${message.frameId}`);
  expect(message.childFrameId === common.MavFrame.BODY_FRD, `child_frame_id ${message.childFrameId}`);
  expect(message.estimatorType === common.MavEstimatorType.VISION, `estimator_type ${message.estimatorType}`);
  checkQuality(message.quality, pose.false_lock_probability);
}

function checkQuality(found, probability) {
  const known = typeof probability === 'number' && probability >= 0;
  const expected = known ? Math.max(1, Math.floor(100 * (1 - probability))) : 0;
  expect(found === expected, `quality: ${found} instead of ${expected}`);
}

function checkHeartbeat(message) {
  expect(message.type === minimal.MavType.ONBOARD_CONTROLLER, `type ${message.type}`);
  expect(message.autopilot === minimal.MavAutopilot.INVALID, `autopilot ${message.autopilot}`);
  expect(message.systemStatus === minimal.MavState.ACTIVE, `system_status ${message.systemStatus}`);
  expect(message.mavlinkVersion === 3, `mavlink_version ${message.mavlinkVersion}`);
}

// --- the stream ---

const REGISTRY = { ...minimal.REGISTRY, ...common.REGISTRY };

// The unit's counter; at a restart of the unit one more, whatever it begins with.
function withResets(groups) {
  let counter = null;
  let before = 0;
  return groups.map((pose) => {
    if (counter === null) counter = pose.reset_count;
    else if (pose.restarted) counter += 1;
    else counter += pose.reset_count - before;
    before = pose.reset_count;
    return { ...pose, resets: counter & 0xff };
  });
}

function heartbeats(groups) {
  let last = null;
  return groups.filter(({ arrival_s: seconds }) => {
    const now = microseconds(seconds);
    const due = last === null || now < last || now - last >= 1e6;
    if (due) last = now;
    return due;
  }).length;
}

function check(packets, groups) {
  const poses = new Map(withResets(groups).filter((g) => g.valid).map((g) => [exposureUs(g), g]));
  const seen = { HEARTBEAT: 0, VISION_POSITION_ESTIMATE: 0, ODOMETRY: 0 };
  for (const packet of packets) {
    expect(packet.header.sysid === 1 && packet.header.compid === 197, 'not from system 1, component 197');
    const type = REGISTRY[packet.header.msgid];
    const message = packet.protocol.data(packet.payload, type);
    expect(type.MSG_NAME in seen, `${type.MSG_NAME}: not expected`);
    seen[type.MSG_NAME] += 1;
    if (type.MSG_NAME === 'HEARTBEAT') {
      checkHeartbeat(message);
      continue;
    }
    const time = message.usec ?? message.timeUsec;
    const pose = poses.get(time);
    expect(pose, `${type.MSG_NAME} at ${time} us: no such pose`);
    expect(message.resetCounter === pose.resets, `reset_counter ${message.resetCounter} instead of ${pose.resets}`);
    (type.MSG_NAME === 'ODOMETRY' ? checkOdometry : checkVision)(message, pose);
  }
  expect(poses.size >= MIN_POSES, `${poses.size} poses in the log: at least ${MIN_POSES} are needed`);
  checkCounts(seen, { HEARTBEAT: heartbeats(groups), VISION_POSITION_ESTIMATE: poses.size, ODOMETRY: poses.size });
  return { seen, poses: poses.size };
}

function checkCounts(seen, sent) {
  for (const [name, count] of Object.entries(sent)) {
    const enough = seen[name] <= count && seen[name] >= count / 2;
    expect(enough, `${name}: ${seen[name]} arrived of ${count}`);
  }
}

// --- the program under test ---

async function listen() {
  const socket = createSocket({ type: 'udp4', recvBufferSize: 1 << 20 });
  socket.bind(0, '127.0.0.1');
  await once(socket, 'listening');
  return socket;
}

// The library's splitter leaves out what fails its checksum: it is counted here.
function parserOf(packets, socket) {
  const broken = [];
  const splitter = new MavLinkPacketSplitter({}, { onCrcError: (buffer) => broken.push(buffer) });
  splitter.pipe(new MavLinkPacketParser()).on('data', (packet) => packets.push(packet));
  let bytes = 0;
  socket.on('message', (datagram) => {
    if (datagram.length === 0) return socket.emit('drained');
    bytes += datagram.length;
    splitter.write(datagram);
  });
  return async () => {
    splitter.end();
    await once(splitter, 'close');
    await new Promise(setImmediate);
    expect(broken.length === 0, `${broken.length} frames with a wrong checksum`);
    const taken = packets.reduce((sum, packet) => sum + packet.buffer.length, 0);
    expect(taken === bytes, `${bytes - taken} bytes are no frame`);
  };
}

// An empty datagram to oneself comes after all that came before it.
async function drain(socket) {
  const { port } = socket.address();
  const again = setInterval(() => socket.send(Buffer.alloc(0), port, '127.0.0.1'), 50);
  await once(socket, 'drained');
  clearInterval(again);
}

// Lines are taken no faster than datagrams: a full pipe holds the program up, so that it does not
// send more than the socket can keep.
async function groupsOf(child, packets) {
  const groups = [];
  let rest = '';
  for await (const chunk of child.stdout.setEncoding('utf8')) {
    const lines = (rest + chunk).split('\n');
    rest = lines.pop();
    groups.push(...lines.map((line) => JSON.parse(line)).filter(({ verdict }) => verdict === 'fresh'));
    await quiet(packets);
  }
  return groups;
}

async function quiet(packets) {
  for (let idle = 0, before = packets.length; idle < 3; before = packets.length) {
    await new Promise((resolve) => setTimeout(resolve, 1));
    idle = packets.length === before ? idle + 1 : 0;
  }
}

async function monitored(dottrack, log, socket) {
  const packets = [];
  const finish = parserOf(packets, socket);
  const target = `127.0.0.1:${socket.address().port}`;
  const child = spawn(dottrack, ['monitor', '--log', log, '--json', '--mavlink', target], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const [groups, [status]] = await Promise.all([groupsOf(child, packets), once(child, 'close')]);
  expect(status === 0, `${dottrack} monitor: exit status ${status}`);
  await drain(socket);
  await finish();
  return check(packets, groups);
}

async function run(dottrack, log) {
  const socket = await listen();
  try {
    return await monitored(dottrack, log, socket);
  } finally {
    socket.close();
  }
}

async function main([dottrack, log]) {
  if (!dottrack || !log) {
    console.error('usage: node mavlink_check.mjs DOTTRACK CAN.LOG');
    return 2;
  }
  try {
    const { seen, poses } = await run(dottrack, log);
    const counts = Object.entries(seen).map(([name, count]) => `${count} ${name}`).join(', ');
    console.log(`MAVLink: ${poses} poses; ${counts}: all agree`);
    return 0;
  } catch (error) {
    console.error(`MAVLink: ${error.message}`);
    return 1;
  }
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) process.exitCode = await main(process.argv.slice(2));
