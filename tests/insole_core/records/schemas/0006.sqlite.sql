BEGIN TRANSACTION;
CREATE TABLE accounts (
	id TEXT NOT NULL, 
	name TEXT NOT NULL, 
	full_name TEXT NOT NULL, 
	role TEXT NOT NULL, 
	password_hash TEXT NOT NULL, 
	failures INTEGER DEFAULT '0' NOT NULL, 
	locked_until TEXT, 
	is_disabled BOOLEAN DEFAULT false NOT NULL, 
	changed_at TEXT NOT NULL, must_change_password BOOLEAN DEFAULT false NOT NULL, system_user TEXT, 
	CONSTRAINT pk_accounts PRIMARY KEY (id), 
	CONSTRAINT uq_accounts_name UNIQUE (name)
);
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0006');
CREATE TABLE audit (
	seq BIGINT NOT NULL, 
	at TEXT NOT NULL, 
	author TEXT NOT NULL, 
	station TEXT NOT NULL, 
	action TEXT NOT NULL, 
	subject_kind TEXT NOT NULL, 
	subject_id TEXT NOT NULL, 
	details TEXT DEFAULT '{}' NOT NULL, 
	previous_hash TEXT NOT NULL, 
	hash TEXT NOT NULL, 
	CONSTRAINT pk_audit PRIMARY KEY (seq)
);
INSERT INTO "audit" VALUES(1,'2026-11-22T16:15:32.553270Z','anna','desk','added','person','eaf6240a-78a1-454d-b718-a6c97d81d1df','{}','0000000000000000000000000000000000000000000000000000000000000000','1fb58b52a237cfc3e609f980854fee45a3046871287b1fcf6c431f7ec0ddc0b7');
INSERT INTO "audit" VALUES(2,'2026-11-22T16:15:32.567288Z','anna','desk','added','visit','094bc03c-78f1-4061-b923-d62cc260ad12','{"person":"eaf6240a-78a1-454d-b718-a6c97d81d1df"}','1fb58b52a237cfc3e609f980854fee45a3046871287b1fcf6c431f7ec0ddc0b7','dd70f60c4e6633bdf02f9a2c9c1a1bb60e4863a8a441eaf8bbb9a6cb0b382f35');
INSERT INTO "audit" VALUES(3,'2026-11-22T16:15:32.693443Z','anna','desk','changed','prescription','2781890f-5432-458e-a80c-bba7e5d77ddd','{"revision":1,"side":"left"}','dd70f60c4e6633bdf02f9a2c9c1a1bb60e4863a8a441eaf8bbb9a6cb0b382f35','10fcd87c498cae1de411a21c10a674f88aec8090e890319a9deb8406bc148eb9');
INSERT INTO "audit" VALUES(4,'2026-11-22T16:15:32.701113Z','anna','desk','added','order','130023e5-2d6a-4f3f-a35d-e3c5e69d5fe5','{"visit":"094bc03c-78f1-4061-b923-d62cc260ad12"}','10fcd87c498cae1de411a21c10a674f88aec8090e890319a9deb8406bc148eb9','549184ca69f2502e9188294328e2333b555a8da2c15cc2211593ccb36d10bc79');
INSERT INTO "audit" VALUES(5,'2026-11-22T16:15:32.708596Z','anna','desk','seen','person','eaf6240a-78a1-454d-b718-a6c97d81d1df','{}','549184ca69f2502e9188294328e2333b555a8da2c15cc2211593ccb36d10bc79','9dcf0c1b6a3d65d683e459d5d7113848642ec4ad69fd3c924bdf7e37683820ee');
INSERT INTO "audit" VALUES(6,'2026-11-26T16:10:51.710432Z','Insole Studio','vm','sealed','person','rows','{"eaf6240a-78a1-454d-b718-a6c97d81d1df":"48353dd503703c9f3618b71a749253ea"}','9dcf0c1b6a3d65d683e459d5d7113848642ec4ad69fd3c924bdf7e37683820ee','3523ed3d87625211d552f39c985cd2abe63b26ee655a15e06d978668fbc30457');
INSERT INTO "audit" VALUES(7,'2026-11-26T16:10:51.730783Z','Insole Studio','vm','sealed','visit','rows','{"094bc03c-78f1-4061-b923-d62cc260ad12":"de5a8a84ebcbbff2be4ff82912488f76"}','3523ed3d87625211d552f39c985cd2abe63b26ee655a15e06d978668fbc30457','eeffe44e62d67819bcae4a54f482a66c3d98d19ba705df8c3a09e92651653ed4');
INSERT INTO "audit" VALUES(8,'2026-11-26T16:10:51.739210Z','Insole Studio','vm','sealed','prescription','rows','{"2781890f-5432-458e-a80c-bba7e5d77ddd":"6ba75c6d5d8b97ca96e8c621cd1420dd"}','eeffe44e62d67819bcae4a54f482a66c3d98d19ba705df8c3a09e92651653ed4','7618de84181c29ceebbe0e3508f5d5d307f098e0d8e1cf22d1ae0b8f9635c6be');
INSERT INTO "audit" VALUES(9,'2026-11-26T16:10:51.782249Z','Insole Studio','vm','sealed','order','rows','{"130023e5-2d6a-4f3f-a35d-e3c5e69d5fe5":"f105c6e02d84cf2579df1511b2000fde"}','7618de84181c29ceebbe0e3508f5d5d307f098e0d8e1cf22d1ae0b8f9635c6be','7bfc05d29daf0c3a0de8c39e6ea7846d56bc010df193cf04a795dfbf68e12a3a');
INSERT INTO "audit" VALUES(10,'2026-11-26T16:10:51.790817Z','Insole Studio','vm','sealed','clinic','rows','{"contents_identity":"0e60593fa8549e3e5927208d48220090"}','7bfc05d29daf0c3a0de8c39e6ea7846d56bc010df193cf04a795dfbf68e12a3a','bbd0447e8d331d4c2ac0f64286ef27973c86b2a2fdc9c32e9db5993fc603cb28');
CREATE TABLE audit_head (
	id INTEGER NOT NULL, 
	seq BIGINT NOT NULL, 
	hash TEXT NOT NULL, 
	CONSTRAINT pk_audit_head PRIMARY KEY (id)
);
INSERT INTO "audit_head" VALUES(1,10,'bbd0447e8d331d4c2ac0f64286ef27973c86b2a2fdc9c32e9db5993fc603cb28');
CREATE TABLE captures (
	id TEXT NOT NULL, 
	visit_id TEXT NOT NULL, 
	number INTEGER NOT NULL, 
	kind TEXT NOT NULL, 
	file_name TEXT NOT NULL, 
	content_sha256 TEXT NOT NULL, 
	source_sha256 TEXT DEFAULT '' NOT NULL, 
	recorded_at TEXT DEFAULT '' NOT NULL, 
	sensor_serials TEXT DEFAULT '[]' NOT NULL, 
	calibrated_on TEXT DEFAULT '' NOT NULL, 
	calibration_residuals TEXT DEFAULT '{}' NOT NULL, 
	report TEXT DEFAULT '{}' NOT NULL, 
	program_version TEXT NOT NULL, 
	created_at TEXT NOT NULL, 
	author TEXT NOT NULL, 
	CONSTRAINT pk_captures PRIMARY KEY (id), 
	CONSTRAINT fk_captures_content_sha256 FOREIGN KEY(content_sha256) REFERENCES contents (sha256), 
	CONSTRAINT fk_captures_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id), 
	CONSTRAINT uq_captures_visit_id_number UNIQUE (visit_id, number)
);
CREATE TABLE clinic (
	"key" TEXT NOT NULL, 
	value TEXT NOT NULL, 
	CONSTRAINT pk_clinic PRIMARY KEY ("key")
);
INSERT INTO "clinic" VALUES('contents_identity','"a35c9416-0f49-4004-94bb-1f85b74f28d3"');
CREATE TABLE contents (
	sha256 TEXT NOT NULL, 
	size BIGINT NOT NULL, 
	kind TEXT NOT NULL, 
	created_at TEXT NOT NULL, 
	CONSTRAINT pk_contents PRIMARY KEY (sha256)
);
INSERT INTO "contents" VALUES('f710c3b7842b09462a9125d0529e2337f9411a76608cbd36234727579d27becf',312785,'mesh','2026-11-22T16:15:32.690774Z');
CREATE TABLE follow_ups (
	id TEXT NOT NULL, 
	person_id TEXT NOT NULL, 
	order_id TEXT, 
	visit_id TEXT, 
	on_date DATE NOT NULL, 
	outcome TEXT DEFAULT '' NOT NULL, 
	notes TEXT DEFAULT '' NOT NULL, 
	author TEXT NOT NULL, 
	created_at TEXT NOT NULL, 
	CONSTRAINT pk_follow_ups PRIMARY KEY (id), 
	CONSTRAINT fk_follow_ups_order_id FOREIGN KEY(order_id) REFERENCES orders (id), 
	CONSTRAINT fk_follow_ups_person_id FOREIGN KEY(person_id) REFERENCES persons (id), 
	CONSTRAINT fk_follow_ups_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id)
);
CREATE TABLE merges (
	id TEXT NOT NULL, 
	kept_id TEXT NOT NULL, 
	merged_id TEXT NOT NULL, 
	moved TEXT NOT NULL, 
	at TEXT NOT NULL, 
	author TEXT NOT NULL, 
	undone_at TEXT, 
	CONSTRAINT pk_merges PRIMARY KEY (id), 
	CONSTRAINT fk_merges_kept_id FOREIGN KEY(kept_id) REFERENCES persons (id), 
	CONSTRAINT fk_merges_merged_id FOREIGN KEY(merged_id) REFERENCES persons (id)
);
CREATE TABLE order_events (
	order_id TEXT NOT NULL, 
	seq INTEGER NOT NULL, 
	at TEXT NOT NULL, 
	author TEXT NOT NULL, 
	from_state TEXT, 
	to_state TEXT NOT NULL, 
	remarks TEXT DEFAULT '' NOT NULL, release INTEGER DEFAULT '1' NOT NULL, 
	CONSTRAINT pk_order_events PRIMARY KEY (order_id, seq), 
	CONSTRAINT fk_order_events_order_id FOREIGN KEY(order_id) REFERENCES orders (id)
);
INSERT INTO "order_events" VALUES('130023e5-2d6a-4f3f-a35d-e3c5e69d5fe5',1,'2026-11-22T16:15:32.698960Z','anna',NULL,'designed','',1);
CREATE TABLE "order_feet" (
	order_id TEXT NOT NULL, 
	prescription_version_id TEXT NOT NULL, 
	release INTEGER DEFAULT '1' NOT NULL, 
	CONSTRAINT pk_order_feet PRIMARY KEY (order_id, prescription_version_id, release), 
	CONSTRAINT fk_order_feet_order_id FOREIGN KEY(order_id) REFERENCES orders (id), 
	CONSTRAINT fk_order_feet_prescription_version_id FOREIGN KEY(prescription_version_id) REFERENCES prescription_versions (id)
);
INSERT INTO "order_feet" VALUES('130023e5-2d6a-4f3f-a35d-e3c5e69d5fe5','2781890f-5432-458e-a80c-bba7e5d77ddd',1);
CREATE TABLE "order_files" (
	order_id TEXT NOT NULL, 
	name TEXT NOT NULL, 
	release INTEGER DEFAULT '1' NOT NULL, 
	content_sha256 TEXT NOT NULL, 
	size BIGINT NOT NULL, 
	CONSTRAINT pk_order_files PRIMARY KEY (order_id, name, release), 
	CONSTRAINT fk_order_files_content_sha256 FOREIGN KEY(content_sha256) REFERENCES contents (sha256), 
	CONSTRAINT fk_order_files_order_id FOREIGN KEY(order_id) REFERENCES orders (id)
);
CREATE TABLE orders (
	id TEXT NOT NULL, 
	number TEXT NOT NULL, 
	visit_id TEXT NOT NULL, 
	person_id TEXT NOT NULL, 
	state TEXT NOT NULL, 
	shop TEXT DEFAULT '' NOT NULL, 
	due_on DATE, 
	remarks TEXT DEFAULT '' NOT NULL, 
	created_at TEXT NOT NULL, 
	changed_at TEXT NOT NULL, 
	revision INTEGER NOT NULL, release INTEGER DEFAULT '1' NOT NULL, place TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_orders PRIMARY KEY (id), 
	CONSTRAINT fk_orders_person_id FOREIGN KEY(person_id) REFERENCES persons (id), 
	CONSTRAINT fk_orders_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id), 
	CONSTRAINT uq_orders_number UNIQUE (number)
);
INSERT INTO "orders" VALUES('130023e5-2d6a-4f3f-a35d-e3c5e69d5fe5','26-W5NXP','094bc03c-78f1-4061-b923-d62cc260ad12','eaf6240a-78a1-454d-b718-a6c97d81d1df','designed','CNC','2026-12-01','','2026-11-22T16:15:32.695230Z','2026-11-22T16:15:32.695230Z',1,1,'');
CREATE TABLE person_words (
	word TEXT NOT NULL, 
	person_id TEXT NOT NULL, 
	CONSTRAINT pk_person_words PRIMARY KEY (word, person_id), 
	CONSTRAINT fk_person_words_person_id FOREIGN KEY(person_id) REFERENCES persons (id)
)
 WITHOUT ROWID

;
INSERT INTO "person_words" VALUES('19700228','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('198112289874','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('26-w5nxp','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('28021970','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('2kf3n227','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('700228','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('8112289874','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('9874','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('anna','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('berg','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('p-2kf3n227','eaf6240a-78a1-454d-b718-a6c97d81d1df');
INSERT INTO "person_words" VALUES('w5nxp','eaf6240a-78a1-454d-b718-a6c97d81d1df');
CREATE TABLE persons (
	id TEXT NOT NULL, 
	name TEXT NOT NULL, 
	search_text TEXT NOT NULL, 
	sort_key TEXT DEFAULT '' NOT NULL, 
	birth_date DATE, 
	personal_number TEXT DEFAULT '' NOT NULL, 
	number_kind TEXT DEFAULT '' NOT NULL, 
	contact TEXT DEFAULT '' NOT NULL, 
	notes TEXT DEFAULT '' NOT NULL, 
	consent_on DATE, 
	pseudonym TEXT NOT NULL, 
	is_erased BOOLEAN DEFAULT false NOT NULL, 
	merged_into TEXT, 
	last_seq BIGINT DEFAULT '0' NOT NULL, 
	created_at TEXT NOT NULL, 
	changed_at TEXT NOT NULL, 
	revision INTEGER NOT NULL, name_key TEXT DEFAULT '' NOT NULL, salt TEXT DEFAULT '' NOT NULL, occupation TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_persons PRIMARY KEY (id), 
	CONSTRAINT fk_persons_merged_into FOREIGN KEY(merged_into) REFERENCES persons (id), 
	CONSTRAINT uq_persons_pseudonym UNIQUE (pseudonym)
);
INSERT INTO "persons" VALUES('eaf6240a-78a1-454d-b718-a6c97d81d1df','Anna Berg',' anna berg 19700228 700228 28021970 198112289874 8112289874 9874 p-2kf3n227 2kf3n227 26-w5nxp w5nxp','anna berg','1970-02-28','19811228-9874','se','','',NULL,'P-2KF3N227',0,NULL,5,'2026-11-22T16:15:32.542544Z','2026-11-22T16:15:32.542544Z',1,'anna berg','31a5be062d6d63d781e07a532454ebd2','');
CREATE TABLE prescription_versions (
	id TEXT NOT NULL, 
	visit_id TEXT NOT NULL, 
	side TEXT NOT NULL, 
	number INTEGER NOT NULL, 
	document TEXT NOT NULL, 
	mesh_sha256 TEXT NOT NULL, 
	capture_id TEXT, 
	author TEXT NOT NULL, 
	station TEXT NOT NULL, 
	reason TEXT DEFAULT '' NOT NULL, 
	program_version TEXT NOT NULL, 
	created_at TEXT NOT NULL, 
	changed_at TEXT NOT NULL, 
	revision INTEGER NOT NULL, 
	is_closed BOOLEAN DEFAULT false NOT NULL, 
	signed_by TEXT, 
	signed_at TEXT, 
	signature TEXT, 
	CONSTRAINT pk_prescription_versions PRIMARY KEY (id), 
	CONSTRAINT fk_prescription_versions_capture_id FOREIGN KEY(capture_id) REFERENCES captures (id), 
	CONSTRAINT fk_prescription_versions_mesh_sha256 FOREIGN KEY(mesh_sha256) REFERENCES contents (sha256), 
	CONSTRAINT fk_prescription_versions_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id), 
	CONSTRAINT uq_prescription_versions_visit_id_side_number UNIQUE (visit_id, side, number)
);
INSERT INTO "prescription_versions" VALUES('2781890f-5432-458e-a80c-bba7e5d77ddd','094bc03c-78f1-4061-b923-d62cc260ad12','left',1,'{"side": "left", "length_mm": 245.23449920464157, "source2insole": [[0.9990730294724757, -0.04300986183341374, -0.001798211823092699, -3.436813259204993], [0.0430449224916815, 0.9985941242955774, 0.030933954969163308, 121.74572312376779], [0.00046521863159445153, -0.030982683993155773, 0.9995198131423932, 0.20500090028788567], [0.0, 0.0, 0.0, 1.0]], "notes": ["A left foot by its shape: seen from above with the toes ahead, the big toe and the high side of the arch lie on the right (margin 2.7 to 1).", "2 small pieces that float beside the foot left out."], "source": {"kind": "mesh", "path": "l.stl", "sha256": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "recorded_at": ""}, "annotations": {"key_points": []}, "variants": [{"name": "A", "design": {"format": "insole-design", "version": 1, "side": "left", "corrections": [], "thickness_mm": 3.0, "grid_mm": 1.0, "max_height_mm": 30.0, "margin_mm": 10.0, "outline": {"source": "foot", "extent": "full", "toe_allowance_mm": 5.0, "ball_allowance_mm": 2.0, "heel_allowance_mm": 2.0}, "layers": {"cover_mm": 0.0, "shell_mm": 0.0, "base_mm": 0.0, "cover_is_taken_off": false}, "bottom": "flat", "device": ""}}], "chosen": "A"}','f710c3b7842b09462a9125d0529e2337f9411a76608cbd36234727579d27becf',NULL,'anna','desk','','0.1.0','2026-11-22T16:15:32.691239Z','2026-11-22T16:15:32.691239Z',1,1,NULL,NULL,NULL);
CREATE TABLE presence (
	visit_id TEXT NOT NULL, 
	station TEXT NOT NULL, 
	author TEXT NOT NULL, 
	since TEXT NOT NULL, 
	seen_at TEXT NOT NULL, 
	CONSTRAINT pk_presence PRIMARY KEY (visit_id, station, author), 
	CONSTRAINT fk_presence_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id)
);
CREATE TABLE visit_photos (
	id TEXT NOT NULL, 
	visit_id TEXT NOT NULL, 
	number INTEGER NOT NULL, 
	content_sha256 TEXT NOT NULL, 
	caption TEXT DEFAULT '' NOT NULL, 
	marks TEXT DEFAULT '[]' NOT NULL, 
	created_at TEXT NOT NULL, 
	changed_at TEXT NOT NULL, 
	revision INTEGER NOT NULL, 
	author TEXT NOT NULL, 
	CONSTRAINT pk_visit_photos PRIMARY KEY (id), 
	CONSTRAINT fk_visit_photos_content_sha256 FOREIGN KEY(content_sha256) REFERENCES contents (sha256), 
	CONSTRAINT fk_visit_photos_visit_id FOREIGN KEY(visit_id) REFERENCES visits (id), 
	CONSTRAINT uq_visit_photos_visit_id_number UNIQUE (visit_id, number)
);
CREATE TABLE visits (
	id TEXT NOT NULL, 
	person_id TEXT NOT NULL, 
	visited_on DATE NOT NULL, 
	reason TEXT DEFAULT '' NOT NULL, 
	findings TEXT DEFAULT '' NOT NULL, 
	weight_kg FLOAT, 
	shoe_size_eu FLOAT, 
	measures TEXT DEFAULT '{}' NOT NULL, 
	capture_state TEXT DEFAULT 'none' NOT NULL, 
	created_at TEXT NOT NULL, 
	changed_at TEXT NOT NULL, 
	revision INTEGER NOT NULL, terms TEXT DEFAULT '{}' NOT NULL, 
	CONSTRAINT pk_visits PRIMARY KEY (id), 
	CONSTRAINT fk_visits_person_id FOREIGN KEY(person_id) REFERENCES persons (id)
);
INSERT INTO "visits" VALUES('094bc03c-78f1-4061-b923-d62cc260ad12','eaf6240a-78a1-454d-b718-a6c97d81d1df','2026-11-20','','flat foot',70.5,NULL,'{}','none','2026-11-22T16:15:32.563714Z','2026-11-22T16:15:32.563714Z',1,'{}');
CREATE INDEX ix_audit_subject_id ON audit (subject_id);
CREATE INDEX ix_persons_last_seq ON persons (last_seq);
CREATE INDEX ix_persons_personal_number ON persons (personal_number);
CREATE INDEX ix_persons_sort_key ON persons (sort_key);
CREATE INDEX ix_merges_kept_id ON merges (kept_id);
CREATE INDEX ix_merges_merged_id ON merges (merged_id);
CREATE INDEX ix_visits_capture_state ON visits (capture_state);
CREATE INDEX ix_visits_person_id_visited_on ON visits (person_id, visited_on);
CREATE INDEX ix_visits_visited_on ON visits (visited_on);
CREATE INDEX ix_captures_content_sha256 ON captures (content_sha256);
CREATE INDEX ix_orders_person_id ON orders (person_id);
CREATE INDEX ix_orders_state_due_on ON orders (state, due_on);
CREATE INDEX ix_orders_visit_id ON orders (visit_id);
CREATE INDEX ix_follow_ups_order_id ON follow_ups (order_id);
CREATE INDEX ix_follow_ups_person_id ON follow_ups (person_id);
CREATE INDEX ix_follow_ups_visit_id ON follow_ups (visit_id);
CREATE INDEX ix_prescription_versions_mesh_sha256 ON prescription_versions (mesh_sha256);
CREATE TRIGGER audit_update BEFORE UPDATE ON audit BEGIN SELECT RAISE(ABORT, 'the audit log is only appended to') WHERE true; END;
CREATE TRIGGER audit_delete BEFORE DELETE ON audit BEGIN SELECT RAISE(ABORT, 'the audit log is only appended to') WHERE true; END;
CREATE TRIGGER audit_head_delete BEFORE DELETE ON audit_head BEGIN SELECT RAISE(ABORT, 'the audit log is only appended to') WHERE true; END;
CREATE TRIGGER audit_head_update BEFORE UPDATE ON audit_head BEGIN SELECT RAISE(ABORT, 'the audit log is only appended to') WHERE NEW.id <> OLD.id OR NEW.seq <= OLD.seq; END;
CREATE TRIGGER version_delete BEFORE DELETE ON prescription_versions BEGIN SELECT RAISE(ABORT, 'a closed or signed prescription cannot be changed') WHERE OLD.is_closed AND NOT EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id WHERE visits.id = OLD.visit_id AND persons.is_erased); END;
CREATE INDEX ix_persons_name_key_birth_date ON persons (name_key, birth_date);
CREATE INDEX ix_persons_merged_into ON persons (merged_into);
CREATE INDEX ix_audit_author_seq ON audit (author, seq);
CREATE INDEX ix_audit_at_seq ON audit (at, seq);
CREATE TRIGGER person_insert AFTER INSERT ON persons BEGIN INSERT INTO person_words (word, person_id) SELECT DISTINCT value, NEW.id FROM json_each('[' || replace(json_quote(NEW.search_text), ' ', '","') || ']') WHERE value <> ''; END;
CREATE TRIGGER person_delete BEFORE DELETE ON persons BEGIN DELETE FROM person_words WHERE person_id = OLD.id AND word IN (SELECT  value FROM json_each('[' || replace(json_quote(OLD.search_text), ' ', '","') || ']') WHERE value <> ''); END;
CREATE TRIGGER person_update AFTER UPDATE OF search_text ON persons WHEN OLD.search_text <> NEW.search_text BEGIN DELETE FROM person_words WHERE person_id = OLD.id AND word IN (SELECT  value FROM json_each('[' || replace(json_quote(OLD.search_text), ' ', '","') || ']') WHERE value <> ''); INSERT INTO person_words (word, person_id) SELECT DISTINCT value, NEW.id FROM json_each('[' || replace(json_quote(NEW.search_text), ' ', '","') || ']') WHERE value <> ''; END;
CREATE UNIQUE INDEX ix_accounts_system_user ON accounts (system_user);
CREATE TRIGGER version_update BEFORE UPDATE ON prescription_versions BEGIN SELECT RAISE(ABORT, 'a closed or signed prescription cannot be changed') WHERE (OLD.is_closed AND (OLD.id IS NOT NEW.id OR OLD.visit_id IS NOT NEW.visit_id OR OLD.side IS NOT NEW.side OR OLD.number IS NOT NEW.number OR OLD.mesh_sha256 IS NOT NEW.mesh_sha256 OR OLD.capture_id IS NOT NEW.capture_id OR OLD.author IS NOT NEW.author OR OLD.station IS NOT NEW.station OR OLD.program_version IS NOT NEW.program_version OR OLD.created_at IS NOT NEW.created_at OR OLD.changed_at IS NOT NEW.changed_at OR OLD.is_closed IS NOT NEW.is_closed OR ((OLD.document IS NOT NEW.document OR OLD.reason IS NOT NEW.reason) AND NOT EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id WHERE visits.id = OLD.visit_id AND persons.is_erased)))) OR (OLD.signature IS NOT NULL AND (OLD.signature IS NOT NEW.signature OR OLD.signed_by IS NOT NEW.signed_by OR OLD.signed_at IS NOT NEW.signed_at)); END;
CREATE INDEX ix_order_feet_prescription_version_id ON order_feet (prescription_version_id);
CREATE INDEX ix_order_files_content_sha256 ON order_files (content_sha256);
CREATE INDEX ix_visit_photos_content_sha256 ON visit_photos (content_sha256);
COMMIT;
