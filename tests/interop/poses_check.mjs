// What candied reads of a CAN log against what the tracker found: the poses.csv of the same run.
// Only DBC and log are common to both, so this sees a wrong layout as well as a wrong encoder.

// Groups of a log: signals of all messages with the sequence of the Status or FdPose that began it.
export function groupsOf(messages) {
  const groups = [];
  for (const message of messages) {
    const signals = Object.fromEntries([...message.boundSignals].map(([name, bound]) => [name, known(bound)]));
    if (/_(Status|FdPose)$/.test(message.name)) groups.push({});
    const group = groups.at(-1);
    if (!group || /_(Dot\d+\w+|Version|Configuration|Reply|Command|Cameras)$/.test(message.name)) continue;
    if (group.Sequence === undefined || group.Sequence === signals.Sequence) Object.assign(group, signals);
  }
  return groups.filter((group) => group.MidExposure !== undefined && group.QZ !== undefined);
}

// The word of the value table, else the physical value; null where the file says "not available".
function known({ rawValue, boundData: { signal } }) {
  const word = signal.valueTable?.get(rawValue);
  return word === 'not available' ? null : (word ?? rawValue * signal.factor + signal.offset);
}

export function posesOf(csv) {
  const [header, ...rows] = csv.split('\n').filter(Boolean).map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(header.map((name, i) => [name, row[i]])));
}

const METRES = 0.0001 / 2;
const COMPONENT = 0.000031 / 2;
const SIGMA = 0.000005;
const LARGEST_INFLATION = 1.05; // of a variance, for the rounding of correlations
const ROUNDING = 1e-9;

const bits = (mask) => [...mask.toString(2)].filter((bit) => bit === '1').length;
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance + ROUNDING;

function differsInPose(group, pose) {
  const position = ['x', 'y', 'z'].every((axis) => near(group[axis.toUpperCase()], pose[`${axis}_m`], METRES));
  const parts = ['w', 'x', 'y', 'z'].map((part) => [group[`Q${part.toUpperCase()}`], Number(pose[`q${part}`])]);
  const orientation = [1, -1].some((sign) => parts.every(([a, b]) => near(a, sign * b, COMPONENT)));
  return (!position && 'position') || (!orientation && 'orientation') || differsInSigma(group, pose);
}

function differsInSigma(group, pose) {
  for (const axis of ['x', 'y', 'z', 'roll', 'pitch', 'yaw']) {
    const sigma = group[`Sigma${axis[0].toUpperCase()}${axis.slice(1)}`];
    const variance = Number(pose[`cov_${axis}_${axis}`]);
    if (sigma === null || sigma === undefined) continue;
    const most = Math.sqrt(variance * LARGEST_INFLATION) + SIGMA;
    if (sigma < Math.sqrt(variance) || sigma > most + ROUNDING) return `sigma of ${axis}`;
  }
  return '';
}

function differs(group, pose) {
  if (group.State !== pose.state) return 'state';
  if (group.Reason !== pose.reason) return 'reason';
  if (group.ResetCount !== Number(pose.reset_count) % 256) return 'reset count';
  if ((group.PoseValid === 1) !== (pose.x_m !== '')) return 'validity';
  if (group.PoseValid !== 1) return group.X === null && group.QW === null ? '' : 'a pose that is not valid';
  if (bits(group.CamerasUsed) !== Number(pose.cameras_used)) return 'number of cameras';
  if (group.DotsUsed !== Number(pose.dots_used)) return 'number of dots';
  return differsInPose(group, pose);
}

// Matches groups and rows by the time of capture. A word on the first difference, or the counts.
export function compareWithPoses(groups, poses) {
  const microseconds = (pose) => Math.round(Number(pose.t_s) * 1e6);
  const start = groups[0].MidExposure - microseconds(poses[0]);
  const rows = new Map(poses.map((pose) => [microseconds(pose) + start, pose]));
  let valid = 0;
  for (const group of groups) {
    const pose = rows.get(group.MidExposure);
    const what = pose ? differs(group, pose) : 'no row of this time of capture';
    if (what) return { difference: `${what}: ${JSON.stringify(group)}` };
    valid += group.PoseValid;
  }
  return { groups: groups.length, valid };
}
