// The sound of alarms: a few tones when one is raised, again while a critical one waits for somebody.

import { untrack } from 'svelte';
import { keptChoice } from './choice';
import { type OpenAlarm, openAlarms } from './open_alarms';
import { identityOf } from './severity';

const kept = keptChoice('stommel-sound');
const AGAIN_MS = 20_000;

/** Tones of a severity: frequency in Hz, one after another. */
const TONES: Record<string, readonly number[]> = {
  critical: [880, 660, 880, 660],
  warning: [740, 740],
  notice: [587],
};

class Sound {
  isOn = $state(kept.read() === 'on');
  /** The browser makes no sound before somebody has touched the page. */
  isWaiting = $state(false);
  /** How often it has sounded since the page was opened. */
  played = $state(0);
  private context: AudioContext | undefined;
  private waiting = new Map<string, string>();
  private timer: ReturnType<typeof setInterval> | undefined;
  private unlisten: (() => void) | undefined;

  /** Listens to the alarms of all vehicles until `stop`; what was raised while the page was away is heard now. */
  start(): void {
    if (this.unlisten) return;
    this.unlisten = $effect.root(() => {
      $effect(() => {
        const open = openAlarms();
        untrack(() => this.hear(open));
      });
    });
    this.timer = setInterval(() => this.again(), AGAIN_MS);
    window.addEventListener('pointerdown', this.touched);
    window.addEventListener('keydown', this.touched);
  }

  stop(): void {
    this.unlisten?.();
    this.unlisten = undefined;
    clearInterval(this.timer);
    window.removeEventListener('pointerdown', this.touched);
    window.removeEventListener('keydown', this.touched);
    void this.context?.close();
    this.context = undefined;
  }

  switch(isOn: boolean): void {
    this.isOn = isOn;
    kept.keep(isOn ? 'on' : 'off');
    if (isOn) this.play('notice');
  }

  play(severity: string): void {
    this.context ??= new AudioContext();
    const context = this.context;
    this.isWaiting = context.state === 'suspended';
    if (this.isWaiting) void context.resume().then(() => (this.isWaiting = context.state === 'suspended'));
    this.played += 1;
    (TONES[severity] ?? TONES['warning'] ?? []).forEach((hertz, index) => tone(context, hertz, index * 0.24));
  }

  private touched = (): void => {
    if (this.isOn && this.context?.state === 'suspended') void this.context.resume().then(() => (this.isWaiting = false));
  };

  /** Sounds as the worst of those that nobody has acknowledged and that were not heard before. */
  private hear(open: readonly OpenAlarm[]): void {
    const waiting = open.filter((alarm) => alarm.acknowledged === null);
    const [worst] = waiting.filter((alarm) => !this.waiting.has(identityOf(alarm)));
    this.waiting = new Map(waiting.map((alarm) => [identityOf(alarm), alarm.severity]));
    if (this.isOn && worst) this.play(worst.severity);
  }

  private again(): void {
    if (this.isOn && [...this.waiting.values()].includes('critical')) this.play('critical');
  }
}

function tone(context: AudioContext, hertz: number, after_s: number): void {
  const oscillator = context.createOscillator();
  const gain = context.createGain();
  const begin = context.currentTime + after_s;
  oscillator.frequency.value = hertz;
  gain.gain.setValueAtTime(0, begin);
  gain.gain.linearRampToValueAtTime(0.22, begin + 0.02);
  gain.gain.linearRampToValueAtTime(0, begin + 0.2);
  oscillator.connect(gain).connect(context.destination);
  oscillator.start(begin);
  oscillator.stop(begin + 0.22);
}

export const sound = new Sound();
