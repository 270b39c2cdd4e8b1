// Before anything is painted: the chosen theme, else that of the system.
try {
  var chosen = localStorage.getItem('stommel-theme');
  if (chosen === 'light' || chosen === 'dark') document.documentElement.dataset.theme = chosen;
} catch (_) {
  // Storage is switched off: the system's theme it is.
}
