"""`fsi-compare study`: runs of both drivers as a study file lists them, and the report made from them."""
