void nothing(void) {}
struct point { int32_t x, y; };
// How far it is
int32_t far(struct point *p);
int32_t corners(void) {
  struct point p = {3, 4};
  return far(&p);
}
int32_t far(struct point *p) { return p->x + p->y; }
