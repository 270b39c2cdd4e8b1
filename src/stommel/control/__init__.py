"""Laws that fly a glider, as pure compiled functions: guidance, dive cycle, pitch, heading, buoyancy."""
