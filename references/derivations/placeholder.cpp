#include "references/data/reference.h"
