// bytes: 4 + 4 + 4 + 12 + 4
#include "simpletools.h"
#include "wifi.h"

int event, id, handle;  // nothing changes them: what stands for wifi_poll does nothing
int counts;             // 4: it is read where it is counted
int pages;              // 4: a compiler sees too late that nothing reads it
int stored;             // nothing reads it
int limit = 3;          // nothing changes it
volatile int watched;   // 4: each access counts, though there is none
int samples[3];         // 12: any of them may be asked for
char never[200];        // only what never happens names it

void show(int value) { wifi_print(GET, handle, "value %d\r", value); }

int main() {
  int last = input(3);  // 4: it lasts, as the loop asks for it
  pages = wifi_listen(HTTP, "/page");
  while (1) {
    int mode = wifi_mode(CHECK);
    wifi_poll(&event, &id, &handle);
    if (event == 'G' && id == pages) {
      never[counts] = 1;
      print("a page is asked for: %s\n", never);
    }
    if (mode) never[1] = mode;
    switch (mode) {
      case 1:
        never[2] = 2;
        break;
      default:
        counts++;
    }
    for (int i = 0; i < limit; i++) samples[i] += last;
    do {
      last = samples[counts % 3];
    } while (mode == 5);
    stored = last + 2;
    show(last);
    low(last);
    pause(5);
  }
}
