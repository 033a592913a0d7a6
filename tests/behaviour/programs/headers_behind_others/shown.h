void show(struct entry e)
{
  place p = e.at;
  unsigned char bytes[2] = { 200, 100 };
  printf("%d,%d %d\n", p.x, p.y, bytes[0] << 8 | bytes[1]);
  printf("%d\n", (bytes[0] * bytes[1] + p.x) * 5);
}
