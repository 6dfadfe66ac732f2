// The view as a PNG file, with its scale bar.

export function savePicture(view, bar, title, textColour) {
  const drawn = view.drawnCanvas();
  const canvas = document.createElement('canvas');
  canvas.width = drawn.width;
  canvas.height = drawn.height;
  const context = canvas.getContext('2d');
  context.drawImage(drawn, 0, 0);
  const unit = Math.max(12, Math.round(canvas.width / 60));
  bar.draw(context, canvas.height, unit, textColour);
  context.textAlign = 'left';
  context.fillText(title, unit, 1.6 * unit);
  canvas.toBlob((blob) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = 'shell.png';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
}
