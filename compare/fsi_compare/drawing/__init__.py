"""Pictures of surfaces: colours, views, and a renderer that needs no graphics."""
