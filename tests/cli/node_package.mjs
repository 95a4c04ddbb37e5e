// load('ktx-parse'): a package of the folder $BURNISH_NODE_MODULES, wherever the script that asks stands.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

export async function load(name) {
  const file = createRequire(resolve(process.env.BURNISH_NODE_MODULES) + '/').resolve('./' + name);
  return import(pathToFileURL(file));
}
