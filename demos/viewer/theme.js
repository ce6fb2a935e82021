// Light or dark: as the system has it, or as the visitor chose (parts/light.html). Calls `changed` after each change.
export function followTheme(changed) {
  const theme = document.getElementById('theme'), dark = matchMedia('(prefers-color-scheme: dark)');
  try { theme.value = localStorage.getItem('scree-theme') ?? 'auto'; } catch { /* pages of files may have no storage */ }
  const show = () => (document.documentElement.dataset.theme = theme.value === 'auto' ? (dark.matches ? 'dark' : 'light') : theme.value);
  const follow = () => {
    show();
    changed();
  };
  dark.addEventListener('change', follow);
  theme.addEventListener('change', () => {
    try { localStorage.setItem('scree-theme', theme.value); } catch { /* likewise */ }
    follow();
  });
  show();
}
// Of the outline of the chosen body.
export const accent = () => (document.documentElement.dataset.theme === 'dark' ? [0.35, 0.75, 1, 1] : [0.02, 0.45, 0.95, 1]);
