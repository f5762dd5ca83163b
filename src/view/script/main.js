// The page: a picture that moves, what it is steered by, and curves beside it.

import { DirectionalLight, GridHelper, HemisphereLight, MOUSE, OrthographicCamera, Scene, TOUCH, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { beds, surfaces } from './bodies.js';
import { Curves } from './curves.js';
import { Marks } from './marks.js';
import { Motion, bytesOf } from './motion.js';
import { LEGEND, Paint } from './paint.js';
import { palette, usePalette } from './palette.js';
import { digits, roundUp } from './svg.js';

/** Speeds that are offered: how many seconds of the scene go by in one of the clock. */
const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
/** How long a run is shown for at first, about, s. */
const SHOWN = 8;
/** Factors on deflections that are offered. */
const FACTORS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

const LAYOUT = `
<div class="stage"><canvas></canvas><svg class="marks"></svg><svg class="corner"></svg><svg class="scale"></svg></div>
<div class="side"><label class="of">Curves of <select class="choice"></select></label><div class="curves"></div></div>
<div class="steer">
<button class="play" title="Play or pause (space bar)"></button>
<input class="time" type="range" min="0" max="1" step="any" aria-label="time">
<output class="now"></output>
<label>Speed <select class="speed"></select></label>
<span class="shown"></span>
<label class="of-paint">Colour <select class="paint"><option value="">bodies</option></select></label>
<label class="of-factor">Deflection <input class="factor" type="range" min="0" max="9" step="1" value="0"> <b>1\u00d7</b></label>
<button class="fit" title="Show everything, from where it was seen at first">Reset view</button>
</div>`;

class Player {
  constructor(root, motion) {
    Object.assign(this, { root, motion });
    root.innerHTML = LAYOUT;
    this.part = (name) => root.querySelector(`.${name}`);
    this.stage = this.part('stage');
    this.reach = motion.reach();
    this.box = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
    for (const { point, around } of this.reach) {
      this.box[0].min(point.clone().subScalar(around));
      this.box[1].max(point.clone().addScalar(around));
    }
    this.size = Math.max(this.box[0].distanceTo(this.box[1]), 1e-6);
    this.renderer = new WebGLRenderer({ canvas: root.querySelector('canvas'), antialias: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(palette.stage);
    this.addScene();
    this.project = this.project.bind(this);
    this.marks = new Marks(motion, root.querySelector('svg.marks'), this.project);
    this.marks.picked = (number) => this.pick(number);
    this.curves = new Curves(motion, this.part('choice'), this.part('curves'), (time) => this.seek(time));
    this.curves.chosen = (name) => this.choose(name);
    this.addSteering();
    this.fit();
    this.choose(this.curves.first);
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.resize();
    this.isPlaying = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.isSeen = true;
    new IntersectionObserver(([entry]) => { this.isSeen = entry.isIntersecting; }).observe(this.stage);
    this.seek(motion.start);
    requestAnimationFrame((now) => this.tick(now));
  }

  addScene() {
    const { motion } = this;
    this.scene = new Scene();
    this.scene.add(new HemisphereLight(palette.sky, palette.soil, 2.1));
    this.camera = new OrthographicCamera();
    const light = new DirectionalLight(palette.sky, 1.6);
    light.position.set(-0.6, 1.1, 1.2);
    this.camera.add(light);
    this.scene.add(this.camera);
    if (motion.dimension === 3 && !motion.surfaces?.length) this.addFloor();
    this.beds = beds(motion);
    for (const bed of this.beds) this.scene.add(bed.object);
    this.surfaces = surfaces(motion, this.size);
    for (const surface of this.surfaces) this.scene.add(surface.object);
    this.controls = new OrbitControls(this.camera, this.stage);
    this.controls.enableDamping = false;
    if (motion.dimension === 2) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    }
    this.controls.addEventListener('change', () => { this.isViewNew = true; });
  }

  /** A grid below everything, with round distances. */
  addFloor() {
    const [low, high] = this.box;
    const span = Math.max(high.x - low.x, high.y - low.y, 0.3 * this.size);
    const step = roundUp(span / 8);
    const count = 2 * Math.ceil((0.62 * span) / step);
    const grid = new GridHelper(count * step, count, palette['floor-axis'], palette.floor);
    grid.rotation.x = Math.PI / 2;
    const middle = (a, b) => Math.round((0.5 * (a + b)) / step) * step;
    grid.position.set(middle(low.x, high.x), middle(low.y, high.y), low.z - 0.02 * this.size);
    this.scene.add(grid);
    this.floor = grid;
  }

  addSteering() {
    const { motion } = this;
    const [play, time, speed, shown] = ['play', 'time', 'speed', 'shown'].map(this.part);
    const wanted = (motion.end - motion.start) / SHOWN;
    for (const offered of SPEEDS) speed.append(new Option(`${digits(offered)}\u00d7`, offered));
    const near = [...SPEEDS].sort((a, b) => Math.abs(Math.log(a / wanted)) - Math.abs(Math.log(b / wanted)))[0];
    speed.value = motion.end > motion.start ? near : 1;
    play.addEventListener('click', () => this.toggle());
    [time.min, time.max] = [motion.start, motion.end];
    time.addEventListener('input', () => {
      this.isPlaying = false;
      this.seek(Number(time.value));
    });
    this.part('fit').addEventListener('click', () => this.fit());
    this.root.addEventListener('keydown', (event) => {
      if (event.key === ' ' && event.target.tagName !== 'BUTTON' && event.target.tagName !== 'SELECT') {
        event.preventDefault();
        this.toggle();
      }
    });
    this.addPaint();
    this.addFactor();
    const has = { names: true, paths: motion.markers.length, joints: motion.marks.length };
    for (const [group, isReaction] of [['loads', false], ['reactions', true]]) {
      has[group] = this.marks.inWords(isReaction);
    }
    for (const name of Object.keys(has).filter((of) => has[of])) {
      const [label, box] = [document.createElement('label'), document.createElement('input')];
      box.type = 'checkbox';
      box.className = name;
      box.checked = name !== 'reactions';
      const show = () => {
        this.marks.groups[name].style.display = box.checked ? '' : 'none';
        this.draw();
      };
      box.addEventListener('change', show);
      label.append(box, ` ${name}`);
      if (typeof has[name] === 'string') label.title = `Longest arrow: ${has[name]}`;
      shown.append(label);
      if (!box.checked) this.marks.groups[name].style.display = 'none';
    }
  }

  /** What bodies may be coloured by. */
  addPaint() {
    const choice = this.part('paint');
    const names = Paint.offered(this.motion);
    this.hasPaint = names.length > 0;
    if (!names.length) this.part('of-paint').remove();
    for (const name of names) choice.append(new Option(name, name));
    choice.addEventListener('change', () => {
      this.paint = choice.value ? new Paint(this.motion, choice.value) : undefined;
      for (const surface of this.surfaces) surface.paint?.(this.paint);
      this.isViewNew = true;
      this.draw();
    });
  }

  /** The factor on displacements of bodies. */
  addFactor() {
    const [label, slider] = ['of-factor', 'factor'].map(this.part);
    const { motion } = this;
    if (!motion.bodies.some((body) => body.drawn && (body.lengths || body.skin))) label.remove();
    motion.isCarried = motion.bodies.some((body) => body.drawn && body.movesFar(this.size));
    // Bodies that do not fit as they are drawn would come apart.
    const isFitting = motion.isCarried || motion.fits(this.size);
    if (!isFitting) motion.measureFromStart();
    const from = isFitting ? 'where bodies are drawn in the scene' : 'the start of the run';
    label.title = `Factor on displacements from ${from}${motion.isCarried ? ', each carried by its mean motion' : ''}`;
    slider.addEventListener('input', () => {
      motion.factor = FACTORS[slider.value];
      label.querySelector('b').textContent = `${motion.factor}\u00d7`;
      motion.seek(motion.time);
      this.marks.ways = this.marks.wayOfMarkers();
      this.isViewNew = true;
      this.draw();
    });
  }

  toggle() {
    if (!this.isPlaying && this.motion.time >= this.motion.end) this.seek(this.motion.start);
    this.isPlaying = !this.isPlaying;
    this.part('play').classList.toggle('playing', this.isPlaying);
  }

  /** Shows the curves of a marker that was picked. */
  pick(number) {
    this.choose(this.motion.markers[number].name);
  }

  choose(name) {
    this.marks.selected = this.motion.markers.findIndex((marker) => marker.name === name);
    this.curves.show(name);
    this.isViewNew = true;
    if (this.stage.clientWidth) this.draw();
  }

  /** Looks at everything: at the plane from the front, at space from the front, the right and above. */
  fit() {
    const [low, high] = this.box;
    const middle = low.clone().add(high).multiplyScalar(0.5);
    const { camera, controls } = this;
    camera.up.set(...(this.motion.dimension === 2 ? [0, 1, 0] : [0, 0, 1]));
    const away = this.motion.dimension === 2 ? new Vector3(0, 0, 1) : new Vector3(1, -1, 0.816);
    camera.position.copy(middle).addScaledVector(away.normalize(), 4 * this.size);
    [camera.near, camera.far] = [0.01 * this.size, 40 * this.size];
    camera.lookAt(middle);
    camera.updateMatrixWorld();
    // What is seen of everything, across and up, from the middle on.
    const axes = [new Vector3(), new Vector3()];
    camera.matrixWorld.extractBasis(...axes, new Vector3());
    this.half = axes.map((axis) => {
      let [least, most] = [Infinity, -Infinity];
      for (const { point, around } of this.reach) {
        const at = point.clone().sub(middle).dot(axis);
        [least, most] = [Math.min(least, at - around), Math.max(most, at + around)];
      }
      const moved = axis.clone().multiplyScalar((least + most) / 2);
      middle.add(moved);
      camera.position.add(moved);
      return (most - least) / 2;
    });
    camera.zoom = 1;
    controls.target.copy(middle);
    this.resize();
    const lowered = axes[1].clone().multiplyScalar(-(this.lift ?? 0) * (this.basePixel ?? 0));
    camera.position.add(lowered);
    controls.target.add(lowered);
    this.resize();
  }

  resize() {
    const [width, height] = [this.stage.clientWidth, this.stage.clientHeight];
    if (!width || !height) return;
    // Room for names, above for a scale of colours, and below for axes.
    const [beside, below] = [Math.min(80, 0.16 * width), Math.min(90, 0.22 * height)];
    const above = Math.max(Math.min(60, 0.14 * height), this.hasPaint ? LEGEND : 0);
    this.lift = (below - above) / 2;
    const pixel = Math.max(this.half[0] / (width / 2 - beside), (2 * this.half[1]) / (height - above - below), 1e-9);
    const { camera } = this;
    [camera.left, camera.right, camera.top, camera.bottom] = [-width, width, height, -height].map((pixels) => (pixels / 2) * pixel);
    this.basePixel = pixel;
    camera.updateProjectionMatrix();
    this.controls.update();
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.extent = [width, height];
    this.isViewNew = true;
    this.draw();
  }

  /** A point of the scene in pixels of the stage. */
  project(point) {
    const at = point.clone().project(this.camera);
    return [(0.5 + 0.5 * at.x) * this.extent[0], (0.5 - 0.5 * at.y) * this.extent[1]];
  }

  seek(time) {
    this.motion.seek(time);
    this.draw();
  }

  draw() {
    if (!this.extent) return;
    const pixel = this.basePixel / this.camera.zoom;
    this.camera.updateMatrixWorld();
    for (const surface of this.surfaces) surface.update(pixel, this.paint);
    for (const bed of this.beds) bed.update();
    this.renderer.render(this.scene, this.camera);
    Object.assign(this.marks, { pixel, room: this.extent });
    if (this.isViewNew) {
      this.isViewNew = false;
      this.marks.updatePaths();
      this.marks.reserved = [this.marks.orientation(this.part('corner'), this.extent[1])];
      if (this.paint) this.marks.reserved.push(this.paint.legend(this.part('scale'), this.extent[0]));
      else this.part('scale').replaceChildren();
    }
    this.marks.update();
    this.curves.update();
    const { motion } = this;
    this.part('time').value = motion.time;
    this.part('now').textContent = `${motion.time.toFixed(motion.end < 1 ? 4 : motion.end < 100 ? 2 : 1)} s`;
    this.part('play').classList.toggle('playing', this.isPlaying);
  }

  tick(now) {
    const passed = Math.min((now - (this.last ?? now)) / 1000, 0.1);
    this.last = now;
    if (this.isPlaying && this.isSeen && this.motion.end > this.motion.start) {
      const next = this.motion.time + passed * Number(this.part('speed').value);
      if (this.motion.time >= this.motion.end) this.seek(this.motion.start);
      else this.seek(next);
    } else if (this.isViewNew) {
      this.draw();
    }
    requestAnimationFrame((later) => this.tick(later));
  }
}

function hasWebGL() {
  return Boolean(document.createElement('canvas').getContext('webgl2'));
}

function start(root) {
  const content = (name) => root.querySelector(`script.${name}`).textContent;
  const header = JSON.parse(content('header'));
  usePalette(header.palette);
  const motion = new Motion(header, bytesOf(content('numbers')).buffer);
  const fallback = root.querySelector('.fallback');
  if (!hasWebGL()) {
    fallback.querySelector('p').textContent = 'This browser shows no WebGL, which the moving picture needs; here is the scene at its start.';
    return;
  }
  fallback.remove();
  const place = document.createElement('div');
  place.className = 'player';
  place.tabIndex = 0;
  root.append(place);
  window.flexbody = new Player(place, motion);
}

start(document.querySelector('.flexbody-view'));
