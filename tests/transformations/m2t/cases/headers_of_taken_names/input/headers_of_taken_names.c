#include "simpletools.h"
#include "adapters.h"
#include "Print.h"

int main() {
  while (1) {
    high(QA);
    pause(QB * QC + quarter());
  }
}
