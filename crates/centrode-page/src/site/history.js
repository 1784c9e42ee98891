// The texts a design has been, to go back and forth between.

const MOST = 500;

export class History {
  constructor(text) {
    this.texts = [text];
    this.at = 0;
    this.saved = text;
  }

  get text() {
    return this.texts[this.at];
  }

  get dirty() {
    return this.text !== this.saved;
  }

  get canUndo() {
    return this.at > 0;
  }

  get canRedo() {
    return this.at < this.texts.length - 1;
  }

  /** A new text; what had been undone is gone. */
  push(text) {
    if (text === this.text) return;
    this.texts.length = this.at + 1;
    this.texts.push(text);
    if (this.texts.length > MOST) this.texts.shift();
    this.at = this.texts.length - 1;
  }

  undo() {
    if (this.canUndo) this.at -= 1;
    return this.text;
  }

  redo() {
    if (this.canRedo) this.at += 1;
    return this.text;
  }
}
