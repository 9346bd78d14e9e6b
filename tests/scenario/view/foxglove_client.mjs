// Reads a run from `cairn view` with the npm client of Foxglove's protocol, and checks every JSON message with the
// published schemas where these are installed. Prints one JSON object.
//
//   node foxglove_client.mjs FOLDER_WITH_NODE_MODULES ADDRESS SECONDS [SECONDS_UNTIL_A_PAUSE]
import { createRequire } from "node:module";
import { join } from "node:path";

const [folder, address, seconds, until_pause = 0] = process.argv.slice(2);
const require = createRequire(join(folder, "x.js"));
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");

let published;
try {
  const schemas = require("@foxglove/schemas/jsonschema");
  const Ajv = require("ajv").default;
  const ajv = new Ajv({ strict: false, formats: { "date-time": true } });
  published = new Map();
  for (const schema of Object.values(schemas)) published.set(schema.title, ajv.compile(schema));
} catch (error) {
  published = undefined;
}

const result = { name: "", capabilities: [], counts: {}, services: [], checked: 0, wrong: [], answers: {}, failures: [] };
const client = new FoxgloveClient({ ws: new WebSocket(address, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
const byClientId = new Map();

client.on("error", (error) => finish(error.message ?? "error"));
client.on("status", (status) => result.failures.push(status.message));
client.on("serverInfo", (info) => Object.assign(result, { name: info.name, capabilities: info.capabilities }));
client.on("advertise", (channels) => {
  for (const channel of channels) {
    result.counts[channel.topic] = 0;
    byClientId.set(client.subscribe(channel.id), channel);
  }
});
client.on("message", ({ subscriptionId, data }) => {
  const channel = byClientId.get(subscriptionId);
  result.counts[channel.topic] += 1;
  if (channel.encoding !== "json") return;
  const message = JSON.parse(Buffer.from(data.buffer, data.byteOffset, data.byteLength).toString());
  const check = published?.get(channel.schemaName);
  if (!check) return;
  result.checked += 1;
  if (!check(message) && result.wrong.length < 5) result.wrong.push([channel.topic, check.errors[0]]);
});
client.on("advertiseServices", (services) => {
  result.services = services.map((service) => service.name);
  const call = (name, callId, request) =>
    client.sendServiceCallRequest({
      serviceId: services.find((service) => service.name === name).id,
      callId,
      encoding: "json",
      data: new Uint8Array(Buffer.from(JSON.stringify(request))),
    });
  call("/plan", 1, { from: "0.6,0.6", to: "1.0,0.6" });
  setTimeout(() => call("/pause", 2, {}), 1000 * Number(until_pause));
});
client.on("serviceCallResponse", (response) => {
  result.answers[response.callId] = JSON.parse(Buffer.from(response.data.buffer, response.data.byteOffset, response.data.byteLength).toString());
});
client.on("serviceCallFailure", (failure) => {
  result.answers[failure.callId] = failure.message;
});

function finish(error) {
  result.has_schemas = published !== undefined;
  if (error) result.error = error;
  console.log(JSON.stringify(result));
  process.exit(error ? 1 : 0);
}
setTimeout(() => finish(), 1000 * Number(seconds));
