// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A poster becomes the player of its clip when it is clicked, and a poster again when another one plays.
document.addEventListener('click', (event) => {
  const link = event.target.closest?.('.gallery .clip > a');
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey)
    return;
  event.preventDefault();
  for (const player of document.querySelectorAll('.gallery iframe'))
    player.replaceWith(player.poster);
  const player = Object.assign(document.createElement('iframe'), { src: link.href, title: link.dataset.title, allow: 'fullscreen', poster: link });
  link.replaceWith(player);
  player.focus();
});
