// Light and dark: as the system says, until somebody says otherwise.
const kKey = 'tetsoup-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

function stored(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null; // Pages opened from disk may not store anything.
  }
}

export class Theme {
  private choice = stored();

  constructor(private readonly changed: (dark: boolean) => void) {
    system.addEventListener('change', () => this.apply());
  }

  get dark(): boolean {
    return this.choice ? this.choice === 'dark' : system.matches;
  }

  toggle(): void {
    this.choice = this.dark ? 'light' : 'dark';
    try {
      localStorage.setItem(kKey, this.choice);
    } catch {
      // It then holds for this visit only.
    }
    this.apply();
  }

  apply(): void {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light';
    this.changed(this.dark);
  }
}
