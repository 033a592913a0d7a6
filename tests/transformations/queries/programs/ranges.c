/* Each statement is an expression; behind it: its least and greatest value, ? for those that only a type gives, or - for none. */
#define STEP 5
#define FAR (STEP * 10000)
enum mode { FIRST, LAST = 7 };
int outside(void);
unsigned char byte;
int read_from_outside, twice = 3, global;
const int fixed = 12;
int pins[] = {4, 9, 2}, written[] = {1, 2};
static int taken(int passed) { passed; return 0; }  // 3 8

void all(void)
{
  int counter, down, bound = outside();
  char letter = outside();
  read_from_outside = outside();
  twice = 40;
  written[1] = outside();
  taken(3); taken(8);
  7;                                     // 7 7
  -7;                                    // -7 -7
  ~7;                                    // -8 -8
  STEP;                                  // 5 5
  FAR + 1;                               // 50001 50001
  LAST;                                  // 7 7
  fixed;                                 // 12 12
  twice;                                 // 3 40
  global;                                // 0 0
  read_from_outside;                     // -
  byte;                                  // 0 0
  letter;                                // 0 255 ?
  letter << 8;                           // 0 65280 ?
  pins[1];                               // 0 9
  written[0];                            // -
  outside() % 30;                        // -29 29
  outside() & 15;                        // 0 15
  outside() < 3;                         // 0 1
  !bound;                                // 0 1
  (outside() & 7) * 1000;                // 0 7000
  100000 / 3;                            // 33333 33333
  bound ? 3 : 20;                        // 3 20
  (short)5;                              // 5 5
  bound;                                 // -
  for (counter = 0; counter < 10; counter++) {
    counter;                             // 0 10
    counter * 100;                       // 0 1000
  }
  for (down = 20; down >= 2; down--)
    down;                                // 1 20
  for (int k = 0; k < bound; k++)
    k;                                   // -
}
