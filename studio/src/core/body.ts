// The finished mesh with the input's surface hung on it: what is written into files, and what falls.
import type { Core } from './module';
import type { EmbedReport, ExportWish, OutFile } from './protocol';
import type { Mesher } from './mesher';

/** Of the module's own file system. */
const kFolder = '/out/';

export class Body {
  private model = 0;
  private version = -1;

  constructor(private readonly core: Core, private readonly mesher: Mesher) {}

  /** The model of the mesh as it is now. */
  get(name = 'body'): number {
    const { core, mesher } = this;
    if (this.model && this.version === mesher.version) return this.model;
    core.number('model_destroy', this.model);
    this.model = 0;
    core.withTexts([name], (text) =>
      core.call('model_create', mesher.pipeline, text, core.progress, 0, core.result));
    this.model = core.word();
    this.version = mesher.version;
    return this.model;
  }

  report(): EmbedReport {
    this.core.call('model_report', this.get(), this.core.result);
    return this.core.json<EmbedReport>();
  }

  write(wish: ExportWish): { files: OutFile[]; usage: string } {
    const { core } = this;
    const model = this.get();
    const { density, young, poisson } = wish.material;
    core.call('model_set_material', model, density, young, poisson, wish.metresPerUnit);
    core.call('model_set_up', model, wish.up);
    const path = kFolder + wish.name;
    const call = wish.engine ? 'model_write_for_engine' : 'model_write';
    core.withTexts([path, wish.engine ?? wish.format ?? null], (to, how) =>
      core.call(call, model, to, how, core.result));
    const written = core.json<string[] | { files: string[]; usage: string }>();
    const paths = Array.isArray(written) ? written : written.files;
    const files = paths.map((file) => ({ name: file.slice(file.lastIndexOf('/') + 1), bytes: core.takeFile(file) }));
    // Whoever saves the files has them in another folder.
    return { files, usage: Array.isArray(written) ? '' : written.usage.replaceAll(kFolder, '') };
  }
}
