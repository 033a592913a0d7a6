#include <Wire.h>
#include "inner.h"
class DescribedSensor : public Base {
};
