// After all others, in the JavaScript of 2009: a browser that could not read them, or lacks what they stand on, is told so.
(function () {
  var rooms = ['grow-', 'pour-', ''], k;
  if (window.clastRuns) return;
  for (k = 0; k < rooms.length; k += 1) {
    document.getElementById(rooms[k] + 'state').textContent = '';
    document.getElementById(rooms[k] + 'error').textContent = 'This browser is too old for this page, which stands on WebAssembly with SIMD, BigInt and DecompressionStream: '
      + 'Chromium 97, Firefox 113, Safari 16.4 or newer have them.';
  }
}());
