// Writes the bags of tests/data, by programs that are none of ours:
//
//   npm install @mcap/core@2 @foxglove/rosmsg @foxglove/rosmsg-msgs-common @foxglove/rosmsg2-serialization lz4js
//   node make_bags.mjs FOLDER     # needs the command zstd
//
// A robot drives 2 m ahead at 1 m/s, with a laser that is mounted upside down 0.2 m ahead of its centre, and two sonars.
import { McapWriter } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { ros2jazzy } from "@foxglove/rosmsg-msgs-common";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import lz4 from "lz4js";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";

const folder = process.argv[2];

function definitionsOf(type) {
  const [name] = [type.replace("/msg/", "/")];
  const wanted = [name];
  for (let i = 0; i < wanted.length; ++i)
    for (const field of ros2jazzy[wanted[i]].definitions)
      if (field.isComplex && !wanted.includes(field.type)) wanted.push(field.type);
  return wanted.map((one) => ros2jazzy[one]);
}

// The definitions as text, as rosbag2 has them.
function textOf(definitions) {
  return definitions
    .map((one, i) => {
      const fields = one.definitions.map((field) => {
        if (field.isConstant) return `${field.type} ${field.name}=${field.valueText ?? field.value}`;
        const array = field.isArray ? `[${field.arrayLength ?? ""}]` : "";
        return `${field.type}${array} ${field.name}`;
      });
      return (i === 0 ? "" : `${"=".repeat(80)}\nMSG: ${one.name}\n`) + fields.join("\n") + "\n";
    })
    .join("");
}

class Bag {
  bytes = [];
  position = 0n;
  channels = new Map();
  constructor(options) {
    const writable = {
      position: () => this.position,
      write: async (buffer) => {
        this.bytes.push(Buffer.from(buffer));
        this.position += BigInt(buffer.byteLength);
      },
    };
    this.writer = new McapWriter({ writable, ...options });
  }
  async write(topic, type, time_s, message) {
    if (!this.channels.has(topic)) {
      const definitions = definitionsOf(type);
      const text = textOf(definitions);
      const schemaId = await this.writer.registerSchema({ name: type, encoding: "ros2msg", data: Buffer.from(text) });
      const id = await this.writer.registerChannel({ schemaId, topic, messageEncoding: "cdr", metadata: new Map() });
      this.channels.set(topic, { id, writer: new MessageWriter(parse(text, { ros2: true })), sequence: 0 });
    }
    const channel = this.channels.get(topic);
    const time = BigInt(Math.round(time_s * 1e9));
    const data = channel.writer.writeMessage(message);
    await this.writer.addMessage({ channelId: channel.id, sequence: channel.sequence++, logTime: time, publishTime: time, data });
  }
}

const stamp = (time_s) => ({ sec: Math.floor(time_s), nanosec: Math.round((time_s % 1) * 1e9) });
const header = (time_s, frame_id) => ({ stamp: stamp(time_s), frame_id });
const turned = (yaw) => ({ x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) });
const transform = (time_s, parent, child, translation, rotation) => ({
  header: header(time_s, parent), child_frame_id: child, transform: { translation, rotation },
});

async function writeBag(file, options) {
  const bag = new Bag(options);
  await bag.writer.start({ profile: "ros2", library: "@mcap/core" });
  await bag.write("/tf_static", "tf2_msgs/msg/TFMessage", 100, { transforms: [
    transform(100, "base_footprint", "base_link", { x: 0, y: 0, z: 0.1 }, turned(0)),
    transform(100, "base_link", "laser", { x: 0.2, y: 0, z: 0.3 }, { x: 1, y: 0, z: 0, w: 0 }),
    transform(100, "base_link", "sonar_left", { x: 0.1, y: 0.15, z: 0 }, turned(Math.PI / 2)),
    transform(100, "base_link", "sonar_right", { x: 0.1, y: -0.15, z: 0 }, turned(-Math.PI / 2)),
  ] });
  for (let i = 0; i <= 20; ++i) {
    const time_s = 100 + 0.1 * i;
    const pose = { position: { x: 0.1 * i, y: 0, z: 0 }, orientation: turned(0) };
    await bag.write("/rosout_like", "std_msgs/msg/String", time_s, { data: `tick ${i}` });
    await bag.write("/odom", "nav_msgs/msg/Odometry", time_s, {
      header: header(time_s, "odom"), child_frame_id: "base_footprint", pose: { pose, covariance: new Array(36).fill(0) },
      twist: { twist: { linear: { x: 1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } }, covariance: new Array(36).fill(0) },
    });
    await bag.write("/scan", "sensor_msgs/msg/LaserScan", time_s + 0.05, {
      header: header(time_s + 0.05, "laser"), angle_min: -1, angle_max: 1, angle_increment: 0.5, time_increment: 0,
      scan_time: 0.1, range_min: 0.1, range_max: 8, ranges: [1, 1.5, 4 - 0.1 * i, Infinity, 0.05], intensities: [1, 2, 3, 4, 5],
    });
    for (const [side, range] of [["left", 1.25], ["right", i % 2 ? Infinity : 0.75]])
      await bag.write(`/sonar/${side}`, "sensor_msgs/msg/Range", time_s, {
        header: header(time_s, `sonar_${side}`), radiation_type: 0, field_of_view: 0.5, min_range: 0.1, max_range: 3, range,
      });
    await bag.write("/imu", "sensor_msgs/msg/Imu", time_s, {
      header: header(time_s, "base_link"), orientation: turned(0.25), orientation_covariance: new Array(9).fill(0),
      angular_velocity: { x: 0, y: 0, z: 0 }, angular_velocity_covariance: new Array(9).fill(0),
      linear_acceleration: { x: 0, y: 0, z: 9.8 }, linear_acceleration_covariance: new Array(9).fill(0),
    });
  }
  await bag.writer.end();
  writeFileSync(`${folder}/${file}`, Buffer.concat(bag.bytes));
}

const packedBy = (compression, compress) => ({ compressChunk: (data) => ({ compression, compressedData: compress(data) }) });
await writeBag("bag_no_chunks.mcap", { useChunks: false });
await writeBag("bag_no_index.mcap", {
  useStatistics: false, useSummaryOffsets: false, repeatSchemas: false, repeatChannels: false, useMessageIndex: false,
  useChunkIndex: false, useAttachmentIndex: false, useMetadataIndex: false, chunkSize: 4000,
  ...packedBy("lz4", (data) => lz4.compress(data)),
});
await writeBag("bag.mcap", {
  chunkSize: 4000, ...packedBy("zstd", (data) => execFileSync("zstd", ["-c"], { input: data, stdio: ["pipe", "pipe", "ignore"] })),
});
