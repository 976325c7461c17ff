// The page's address. Browsers refuse to be told of more than some hundred changes in ten seconds, of which a slider
// alone makes more.
const kMost = 60;
const kWithin = 10000;
const kLater = 500;

export class Address {
  private timer = 0;
  private times: number[] = [];

  write(settings: string): void {
    clearTimeout(this.timer);
    const now = performance.now();
    this.times = this.times.filter((time) => now - time < kWithin);
    if (this.times.length < kMost) this.writeNow(settings);
    else this.timer = setTimeout(() => this.writeNow(settings), kLater);
  }

  private writeNow(settings: string): void {
    this.times.push(performance.now());
    history.replaceState(null, '', settings ? `#${settings}` : location.pathname + location.search);
  }
}
