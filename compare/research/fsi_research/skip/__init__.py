"""The kind `skip`: what the economies save."""
