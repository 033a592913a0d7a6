static videoLine(ptr, count)
  char *ptr;
  int count;
{
  return send_line(ptr, count);
}
main() { videoLine("x", 1); }
/* expect: send_line videoLine */
