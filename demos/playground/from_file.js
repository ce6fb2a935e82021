// Browsers load no modules and workers for pages that are opened from files: tells so.
if (location.protocol === 'file:') {
  const box = document.getElementById('trouble');
  box.textContent = 'This page is opened from a file, where browsers run no solver. Put its folder behind a web server: python3 -m http.server';
  box.hidden = false;
  document.getElementById('facts').textContent = '';
}
