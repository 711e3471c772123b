// Main script of a page: unpacks its data and shows it.
import {FlatMap} from './flat_map.js';
import {readView, written} from './link.js';
import {contextOf} from './painter.js';
import {showAlternatives, showBuilding, showCredit, showLegend, showLevel, showSource, showSum} from './panels.js';
import {buildingAt} from './pick.js';
import {Relief} from './relief.js';
import {freeRoom} from './room.js';
import {Scene} from './scene.js';
import {fillTexts, texts} from './texts.js';
import {Finder, Measure, SunCard} from './tools.js';
import {Town} from './town.js';
import {unpack} from './unpack.js';

const byId = (id) => document.getElementById(id);

function notice(sentence) {
  byId('notice').textContent = sentence;
  byId('notice').hidden = false;
}

class Page {
  constructor(town) {
    this.town = town;
    this.relief = new Relief(town);
    const onMap = (x, y) => this.measure.isOn() ? this.measure.add([x, y, NaN]) : this.choose(buildingAt(town, x, y));
    this.map = new FlatMap(town, this.relief, byId('map'), freeRoom, onMap);
    this.scene = this.makeScene((x, y) => this.onScene(x, y));
    this.views = this.scene ? [this.scene, this.map] : [this.map];
    this.chosen = -1;
    showSum(town);
    showCredit(town);
    showSource(town);
    showLegend(town);
    this.setUpLevels();
    this.setUpButtons();
    this.setUpTools();
    this.setUpKeys();
    this.setTheme(window.matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    this.show(this.scene ?? this.map);
    for (const view of this.views) {
      view.resize();
      view.home();
    }
    this.follow(readView(window.location.hash));
    window.addEventListener('hashchange', () => this.follow(readView(window.location.hash)));
    window.addEventListener('resize', () => this.views.forEach((view) => view.resize()));
    window.addEventListener('beforeprint', () => this.beginPrint());
    window.addEventListener('afterprint', () => this.endPrint());
  }

  makeScene(onPick) {
    const context = contextOf(byId('view'));
    if (!context) {
      notice(texts.no3d);
      return null;
    }
    const onTurn = (angle) => byId('needle').style.transform = `rotate(${angle}rad)`;
    return new Scene(this.town, this.relief, byId('view'), context, freeRoom, {onPick, onTurn});
  }

  onScene(x, y) {
    if (!this.measure.isOn())
      return this.choose(this.scene.pick(x, y));
    const position = this.scene.positionAt(x, y);
    return position && this.measure.add(position);
  }

  choose(building) {
    this.chosen = building;
    this.views.forEach((view) => view.choose(building));
    showBuilding(this.town, building, () => this.choose(-1));
  }

  show(view) {
    this.shown = view;
    byId('view').hidden = view !== this.scene;
    byId('map').hidden = view !== this.map;
    byId('north').hidden = view !== this.scene;
    byId('sunonly3d').hidden = view === this.scene;
    byId('to3d').setAttribute('aria-pressed', String(view === this.scene));
    byId('tomap').setAttribute('aria-pressed', String(view === this.map));
    view.ask();
  }

  setUpTools() {
    const onFind = (building) => {
      this.choose(building);
      this.shown.goTo(building);
    };
    this.finder = new Finder(this.town, onFind, () => this.refilter());
    showAlternatives(this.town, (value) => this.turnTo(value));
    this.sunCard = new SunCard(this.town, (direction) => this.scene?.setSun(direction));
    this.measure = new Measure((points) => this.views.forEach((view) => view.drawLine(points)));
  }

  // Follows a change of the shown buildings. The same building of another survey stays chosen.
  refilter() {
    this.views.forEach((view) => view.filter());
    showSum(this.town);
    if (this.chosen < 0 || this.town.isShown[this.chosen])
      return;
    const other = this.town.numbered(this.town.stack.id[this.chosen]);
    this.choose(this.town.isShown[other] ? other : -1);
  }

  turnTo(alternative) {
    this.town.showAlternative(alternative);
    for (const button of byId('alternatives').children)
      button.setAttribute('aria-pressed', String(button.dataset.value === alternative));
    this.refilter();
  }

  // Puts the view into the address, so that it can be sent or kept.
  link() {
    const [low, high] = this.finder.heights();
    window.location.hash = written({
      view: this.shown === this.map ? 'map' : '3d',
      ...this.shown.place(),
      level: Number(byId('level').value),
      id: this.chosen < 0 ? null : this.town.stack.id[this.chosen],
      height: low === null && high === null ? null : [low ?? 0, high ?? 10000],
      sun: this.sunCard.chosen(),
      of: this.town.alternative,
    });
    notice(texts.linkDone);
  }

  // @param view of an address, see link.js
  follow(view) {
    if (view.view)
      this.show(view.view === 'map' || !this.scene ? this.map : this.scene);
    if (view.eye && view.to && this.shown === this.scene)
      this.scene.setPlace(view);
    if (view.middle && this.shown === this.map)
      this.map.setPlace(view);
    if (view.level !== undefined) {
      byId('level').value = view.level;
      byId('level').dispatchEvent(new Event('input'));
    }
    if (view.height)
      this.finder.filter(...view.height);
    if (view.sun && this.town.about.position)
      this.sunCard.choose(...view.sun);
    if (this.town.alternatives.includes(view.of))
      this.turnTo(view.of);
    if (view.id !== undefined)
      this.choose(this.town.numbered(view.id));
  }

  setUpLevels() {
    const slider = byId('level');
    slider.max = Math.max(1, this.town.lastLevel);
    slider.value = slider.max;
    slider.disabled = this.town.lastLevel < 2;
    const level = () => Math.min(this.town.lastLevel, Number(slider.value));
    slider.addEventListener('input', () => {
      this.views.forEach((view) => view.setLevel(level()));
      showLevel(this.town, level());
      this.choose(this.chosen);
    });
    showLevel(this.town, level());
  }

  setTheme(theme) {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    byId('theme').textContent = theme === 'dark' ? texts.light : texts.dark;
    this.views.forEach((view) => view.setTheme(theme));
  }

  setUpButtons() {
    const on = (id, act) => byId(id).addEventListener('click', act);
    byId('to3d').disabled = byId('tosun').disabled = !this.scene;
    on('to3d', () => this.show(this.scene));
    on('tomap', () => this.show(this.map));
    on('home', () => this.shown.home());
    on('north', () => this.scene.turnNorth());
    on('link', () => this.link());
    on('print', () => window.print());
    on('theme', () => this.setTheme(this.theme === 'dark' ? 'light' : 'dark'));
    const help = () => {
      byId('about').hidden = !byId('about').hidden;
      byId('help').setAttribute('aria-expanded', String(!byId('about').hidden));
    };
    on('help', help);
    on('closehelp', help);
  }

  setUpKeys() {
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const turned = 1 / 36;
    const moved = 0.06;
    const onKey = (event) => {
      if (arrows[event.key]) {
        const [right, up] = arrows[event.key];
        if (this.shown === this.map || event.shiftKey)
          this.shown.move(right * moved, up * moved);
        else
          this.scene.turn(right * turned, up * turned / 2);
      } else if (event.key === '+' || event.key === '=' || event.key === '-') {
        this.shown.zoom(event.key === '-' ? 1.2 : 1 / 1.2);
      } else if (event.key === 'Home') {
        this.shown.home();
      } else if (event.key === 'Escape') {
        this.choose(-1);
      } else if (event.key === 'Enter' && this.shown === this.scene) {
        this.choose(this.scene.pick(...this.scene.middle()));
      } else {
        return;
      }
      event.preventDefault();
    };
    // Users of the keyboard see the focus.
    document.addEventListener('keydown', () => document.documentElement.dataset.keys = 'yes', true);
    document.addEventListener('pointerdown', () => delete document.documentElement.dataset.keys, true);
    byId('view').addEventListener('keydown', onKey);
    byId('map').addEventListener('keydown', onKey);
  }

  // Paper is light, white and finer than a screen. The map prints its visible part, the scene all of it.
  beginPrint() {
    this.printed = {theme: this.theme, view: this.shown};
    byId('legend').open = true;
    const [west, south, east, north] = this.town.extent;
    const ofMap = this.shown === this.map && !this.map.isHome;
    const [width, height] = ofMap ? [this.map.canvas.width, this.map.canvas.height] : [east - west, north - south];
    const finer = 2400 / Math.max(1, width, height);
    this.setTheme('light');
    this.show(this.map);
    this.map.setSize(Math.round(width * finer), Math.round(height * finer), 3);
    this.map.isPaper = true;
    if (!ofMap)
      this.map.home();
    this.map.draw();
  }

  endPrint() {
    this.map.isPaper = false;
    this.map.resize();
    this.setTheme(this.printed.theme);
    this.show(this.printed.view);
  }
}

async function start() {
  fillTexts();
  if (typeof DecompressionStream === 'undefined') {
    notice(texts.tooOld);
    return;
  }
  const town = new Town(await unpack(byId('data').textContent));
  // Interface for scripts.
  window.dem2buildings = new Page(town);
}

start();
