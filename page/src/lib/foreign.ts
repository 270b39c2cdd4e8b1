// What a file holds that came under another name.

/** Whether the text of a file is that of a picture: by the first bytes of PNG, JPEG and GIF. */
export function isPicture(text: string): boolean {
  return /^.?(PNG|JFIF|GIF8)|^.{3,8}(JFIF|Exif)/s.test(text.slice(0, 20));
}
