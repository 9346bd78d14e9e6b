// Requests to the view, each with the token of its address.
const fragment = new URLSearchParams(location.hash.slice(1));
if (fragment.get('t')) {
  sessionStorage.setItem('cairn-token', fragment.get('t'));
  history.replaceState(null, '', location.pathname);
}
export const token = sessionStorage.getItem('cairn-token') ?? '';

export const element = (id) => document.getElementById(id);
export const say = (text) => { if (element('status').textContent !== text) element('status').textContent = text; };

export async function ask(target, options = {}) {
  const answer = await fetch(target, { ...options, headers: { 'X-Cairn-Token': token, ...options.headers } });
  if (answer.ok) return answer;
  const { error } = await answer.json().catch(() => ({ error: answer.statusText }));
  throw new Error(error);
}

export const ask_json = async (target) => (await ask(target)).json();

export async function post(target, body) {
  const text = typeof body === 'string' ? body : JSON.stringify(body);
  return (await ask(target, { method: 'POST', body: text, headers: { 'Content-Type': 'application/json' } })).json();
}
