// The glider in three dimensions, from its vehicle file. North stands where the ring says; the glider flies to the left
// of the picture at heading, so that its pitch is seen from the side. All that is made is given back by dispose().

import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  CircleGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Euler,
  ExtrudeGeometry,
  Group,
  LatheGeometry,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Shape as Outline,
  Sprite,
  SpriteMaterial,
  Vector2,
  WebGLRenderer,
} from 'three';
import type { Shape } from '../../lib/types';

export interface Attitude {
  pitch_deg: number;
  roll_deg: number;
  heading_deg: number;
}

export interface Colours {
  hull: string;
  ink: string;
  sea: string;
  accent: string;
  soft: string;
}

const RADIANS = Math.PI / 180;
const RING = 1.25;

/** Hull as [distance behind the bow, radius], whatever end the file counts from: its x points forward. */
export function behindBow(profile: readonly [number, number][]): [number, number][] {
  const bow = Math.max(...profile.map(([x]) => x));
  return profile.map(([x, radius]): [number, number] => [bow - x, Math.max(0, radius)]).sort((a, b) => a[0] - b[0]);
}

export class GliderScene {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(28, 1, 0.01, 100);
  private readonly glider = new Group();
  private readonly compass = new Group();
  private readonly colours: Colours;
  private readonly length: number;
  private readonly goal = new Quaternion();
  private heading = 0;
  private azimuth = 76;
  private elevation = 30;
  private frame = 0;
  private still: boolean;

  constructor(canvas: HTMLCanvasElement, shape: Shape, colours: Colours, still: boolean) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: 'low-power' });
    this.colours = colours;
    this.still = still;
    this.length = Math.max(0.1, shape.length_m);
    this.build(shape);
    this.furnish();
    this.scene.add(this.glider, this.compass);
    this.look();
  }

  resize(width: number, height: number): void {
    if (width < 2 || height < 2) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.look();
  }

  /** Turns to an attitude, smoothly unless people want no motion. */
  turn(attitude: Attitude): void {
    const { pitch_deg, roll_deg } = attitude;
    this.goal.setFromEuler(new Euler(pitch_deg * RADIANS, 0, -roll_deg * RADIANS, 'YXZ'));
    this.heading = attitude.heading_deg;
    if (this.still) this.glider.quaternion.copy(this.goal);
    this.draw();
  }

  /** Looks from another side, degrees. */
  orbit(azimuth: number, elevation: number): void {
    this.azimuth += azimuth;
    this.elevation = Math.max(-60, Math.min(85, this.elevation + elevation));
    this.look();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.scene.traverse((one) => {
      if (!(one instanceof Mesh || one instanceof LineSegments || one instanceof Sprite)) return;
      one.geometry.dispose();
      const material = one.material as MeshBasicMaterial;
      material.map?.dispose();
      material.dispose();
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private look(): void {
    const away = 4.9 * Math.max(1, 1.3 / this.camera.aspect);
    const [a, e] = [this.azimuth * RADIANS, this.elevation * RADIANS];
    this.camera.position.set(Math.sin(a) * Math.cos(e) * away, Math.sin(e) * away, Math.cos(a) * Math.cos(e) * away);
    this.camera.lookAt(0, 0, 0);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => {
      this.glider.quaternion.slerp(this.goal, 0.25);
      this.compass.rotation.y = this.heading * RADIANS;
      this.renderer.render(this.scene, this.camera);
      if (this.glider.quaternion.angleTo(this.goal) > 0.002) this.draw();
    });
  }

  /** Scaled so that the glider is 2 long; the bow points to -z, the right wing to +x. */
  private build(shape: Shape): void {
    const scale = 2 / this.length;
    const paint = new MeshStandardMaterial({ color: new Color(this.colours.hull), roughness: 0.45, metalness: 0.05 });
    const dark = new MeshStandardMaterial({ color: new Color('#39464a'), roughness: 0.6, side: DoubleSide });
    const profile = behindBow(shape.profile);
    const last = profile.at(-1)?.[0] ?? this.length;
    const hull = new LatheGeometry(profile.map(([x, r]) => new Vector2(r * scale, (x - last / 2) * scale)), 40);
    hull.rotateX(Math.PI / 2); // from the lathe's y, which runs to the stern, to z
    this.glider.add(new Mesh(hull, paint));
    this.addWings(shape, scale, dark);
    this.addFin(shape, scale, dark);
  }

  private addWings(shape: Shape, scale: number, material: MeshStandardMaterial): void {
    const span = ((shape.wings?.span_m ?? 0.6 * this.length) / 2) * scale;
    const chord = (shape.wings?.chord_m ?? 0.08 * this.length) * scale;
    const sweep = Math.tan((shape.wings?.sweep_deg ?? 15) * RADIANS) * span;
    const from = this.fromMiddle(shape, shape.wings?.x_m) * scale - chord / 2;
    for (const side of [1, -1]) {
      const outline = new Outline();
      outline.moveTo(0, from);
      outline.lineTo(side * span, from + sweep);
      outline.lineTo(side * span, from + sweep + 0.65 * chord);
      outline.lineTo(0, from + chord);
      const wing = new ExtrudeGeometry(outline, { depth: 0.012, bevelEnabled: false });
      wing.rotateX(Math.PI / 2);
      this.glider.add(new Mesh(wing, material));
    }
  }

  private addFin(shape: Shape, scale: number, material: MeshStandardMaterial): void {
    const height = (shape.rudder?.height_m ?? 0.13 * this.length) * scale;
    const chord = (shape.rudder?.chord_m ?? 0.06 * this.length) * scale;
    const back = shape.rudder?.x_m === undefined ? 1 - 1.3 * chord : this.fromMiddle(shape, shape.rudder.x_m) * scale;
    const outline = new Outline();
    outline.moveTo(back, 0);
    outline.lineTo(back + 0.55 * chord, height);
    outline.lineTo(back + 1.1 * chord, height);
    outline.lineTo(back + chord, 0);
    const fin = new ExtrudeGeometry(outline, { depth: 0.012, bevelEnabled: false });
    fin.rotateY(-Math.PI / 2);
    this.glider.add(new Mesh(fin, material));
    const antenna = new BufferGeometry();
    const tip = [0, height * 0.2, Math.min(0.98, back + chord), 0, height * 0.2, Math.min(0.98, back + chord) + 0.35];
    antenna.setAttribute('position', new BufferAttribute(new Float32Array(tip), 3));
    this.glider.add(new LineSegments(antenna, new LineBasicMaterial({ color: new Color(this.colours.ink) })));
  }

  /** Metres behind the middle of the hull; without a place a little behind it. */
  private fromMiddle(shape: Shape, x: number | undefined): number {
    if (x === undefined) return 0.05 * this.length;
    const xs = shape.profile.map(([one]) => one);
    const middle = (Math.max(...xs) + Math.min(...xs)) / 2;
    return middle - x;
  }

  private furnish(): void {
    const sun = new DirectionalLight(0xffffff, 2.4);
    sun.position.set(2, 5, 3);
    this.scene.add(sun, new AmbientLight(0xffffff, 1.1));
    const plane = new MeshBasicMaterial({ color: new Color(this.colours.sea), transparent: true, opacity: 0.55, side: DoubleSide, depthWrite: false });
    const disc = new Mesh(new CircleGeometry(RING, 64), plane);
    disc.rotation.x = -Math.PI / 2;
    this.compass.add(disc, this.ring());
    ['N', 'E', 'S', 'W'].forEach((letter, index) => {
      const angle = index * 90 * RADIANS;
      const label = this.letter(letter, index === 0);
      label.position.set(Math.sin(angle) * (RING + 0.14), 0, -Math.cos(angle) * (RING + 0.14));
      this.compass.add(label);
    });
  }

  private ring(): LineSegments {
    const points: number[] = [];
    for (let degrees = 0; degrees < 360; degrees += 5) {
      const angle = degrees * RADIANS;
      const inner = degrees % 90 === 0 ? RING - 0.16 : degrees % 30 === 0 ? RING - 0.1 : RING - 0.05;
      const next = (degrees + 5) * RADIANS;
      points.push(Math.sin(angle) * inner, 0, -Math.cos(angle) * inner, Math.sin(angle) * RING, 0, -Math.cos(angle) * RING);
      points.push(Math.sin(angle) * RING, 0, -Math.cos(angle) * RING, Math.sin(next) * RING, 0, -Math.cos(next) * RING);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
    return new LineSegments(geometry, new LineBasicMaterial({ color: new Color(this.colours.soft) }));
  }

  private letter(words: string, main: boolean): Sprite {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 64;
    const context = canvas.getContext('2d');
    if (context) {
      context.font = '700 46px system-ui, sans-serif';
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      context.fillStyle = main ? this.colours.accent : this.colours.soft;
      context.fillText(words, 32, 34);
    }
    const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false, sizeAttenuation: false }));
    sprite.scale.setScalar(0.045);
    return sprite;
  }
}
