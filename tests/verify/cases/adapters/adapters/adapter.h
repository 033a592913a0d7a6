#pragma once

void blink(int pin, int times);
